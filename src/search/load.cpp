// SPDX-License-Identifier: MIT
//
// The front of every pass over boxes. Compiled once per SIMD target; the best one for the machine is picked at run
// time.

#include "search/load.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/load.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

using D4 = hn::FixedTag<std::int32_t, 4>;
using V4 = hn::VFromD<D4>;

/// order_key of each lane.
HWY_INLINE V4 order_keys(V4 bits) {
  const D4 d;
  const auto keys = hn::Xor(bits, hn::And(hn::ShiftRight<31>(bits), hn::Set(d, INT32_MAX)));
  return hn::Sub(keys, hn::VecFromMask(d, hn::Eq(keys, hn::Set(d, -1))));  // -0, and nothing else, has become -1
}

HWY_ATTR std::uint64_t LoadRecords(const Aabb* boxes, std::size_t count, std::uint32_t first_id, Record* out) {
  static_assert(sizeof(Aabb) == 24);
  const D4 d;
  const auto infinity = hn::Set(d, static_cast<std::int32_t>(infinity_key<float>));
  const auto minus_infinity = hn::Not(infinity);
  const auto fourth = hn::VecFromMask(d, hn::Eq(hn::Iota(d, 0), hn::Set(d, 3)));
  std::uint64_t valid = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto* bits = reinterpret_cast<const std::int32_t*>(boxes + i);
    const auto lo = order_keys(hn::LoadU(d, bits));                       // and one bound more, both times
    const auto hi = order_keys(hn::Shuffle0321(hn::LoadU(d, bits + 2)));  // so that nothing beyond the box is read
    const auto wrong = hn::Or(hn::Gt(lo, hi), hn::Or(hn::Gt(minus_infinity, lo), hn::Gt(hi, infinity)));
    const bool is_valid = hn::AllFalse(d, hn::AndNot(hn::MaskFromVec(fourth), wrong));
    const auto id = hn::Set(d, static_cast<std::int32_t>(first_id + i));
    hn::StoreU(hn::IfVecThenElse(fourth, id, lo), d, out[i].lo);
    hn::StoreU(hn::AndNot(fourth, hi), d, out[i].hi);
    valid |= std::uint64_t{is_valid} << i;
  }
  return valid;
}

#else

HWY_ATTR std::uint64_t LoadRecords(const Aabb* boxes, std::size_t count, std::uint32_t first_id, Record* out) {
  std::uint64_t valid = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (int d = 0; d < 3; ++d) {
      out[i].lo[d] = order_key(boxes[i].min[d]);
      out[i].hi[d] = order_key(boxes[i].max[d]);
    }
    out[i].id = first_id + static_cast<std::uint32_t>(i);
    out[i].before = 0;
    valid |= std::uint64_t{has_valid_keys(boxes[i])} << i;
  }
  return valid;
}

#endif

HWY_ATTR void Locate(const Record* HWY_RESTRICT records, std::size_t count, const Slabs& slabs,
                     std::uint8_t* HWY_RESTRICT first_slab, std::uint8_t* HWY_RESTRICT last_slab) {
  std::int32_t lo[load_block] = {}, hi[load_block] = {};
  std::uint32_t lo_bucket[load_block], hi_bucket[load_block];
  for (std::size_t i = 0; i < count; ++i) {
    lo[i] = records[i].lo[slabs.axis];
    hi[i] = records[i].hi[slabs.axis];
  }
  const Buckets buckets = slabs.buckets;  // so that the loops keep it in registers
  for (std::size_t i = 0; i < load_block; ++i) lo_bucket[i] = buckets(lo[i]);
  for (std::size_t i = 0; i < load_block; ++i) hi_bucket[i] = buckets(hi[i]);
  for (std::size_t i = 0; i < count; ++i) {
    // cppcheck-suppress uninitvar  // takes the loops above for ones that may not run
    first_slab[i] = slabs.of_bucket[lo_bucket[i]];
    // cppcheck-suppress uninitvar
    last_slab[i] = slabs.of_bucket[hi_bucket[i]];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(LoadRecords);
HWY_EXPORT(Locate);

std::uint64_t load_records(const Aabb* boxes, std::size_t count, std::uint32_t first_id, Record* out) {
  return HWY_DYNAMIC_DISPATCH(LoadRecords)(boxes, count, first_id, out);
}

void locate(const Record* records, std::size_t count, const Slabs& slabs, std::uint8_t* first_slab,
            std::uint8_t* last_slab) {
  HWY_DYNAMIC_DISPATCH(Locate)(records, count, slabs, first_slab, last_slab);
}

}  // namespace boxstream::detail
#endif
