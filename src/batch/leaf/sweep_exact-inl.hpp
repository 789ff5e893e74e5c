// SPDX-License-Identifier: MIT
//
// Boxes of doubles with all their bits, for leaves in which many ends share a key that does not decide.

#if defined(BOXSTREAM_SWEEP_EXACT_INL_HPP_) == defined(HWY_TARGET_TOGGLE)  // once per SIMD target
#ifdef BOXSTREAM_SWEEP_EXACT_INL_HPP_
#undef BOXSTREAM_SWEEP_EXACT_INL_HPP_
#else
#define BOXSTREAM_SWEEP_EXACT_INL_HPP_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "base/arena.hpp"
#include "batch/records/columns_load-inl.hpp"
#include "batch/records/record.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

/// A record with all bits of the bounds: order keys of low ends and of high ends, each with a fourth lane, in which no
/// low end is beyond a high one. That of the low ones holds the id and `before`, so that a box is one line of the
/// cache.
struct alignas(64) ExactRecord {
  std::int64_t lo[3];
  std::uint32_t id, before;
  std::int64_t hi[4];
};

using DExact = hn::CappedTag<std::int64_t, 4>;
constexpr std::size_t exact_lanes = hn::MaxLanes(DExact());

/// Two lines of the cache, mostly.
HWY_INLINE void ask_for_original(const Record& record, const Aabb64* boxes) {
  const auto* const box = reinterpret_cast<const char*>(boxes + record.id);
  hwy::Prefetch(box);
  hwy::Prefetch(box + sizeof(Aabb64) - 1);
}

/// Those of `records`, in their order.
inline HWY_ATTR const ExactRecord* gather_exact(const Record* records, std::size_t size, const Aabb64* boxes,
                                                Arena& arena) {
  constexpr std::size_t ahead = 16;  // each box is a miss of its own
  const DExact d;
  auto* const out = arena.allocate<ExactRecord>(size);
  for (std::size_t i = 0; i < size; ++i) {
    ask_for_original(records[std::min(i + ahead, size - 1)], boxes);
    const auto* const bits = reinterpret_cast<const std::int64_t*>(boxes + records[i].id);
    auto* const ends = reinterpret_cast<std::int64_t*>(out + i);
    const auto copy_four = [&](std::size_t from, std::size_t to) HWY_ATTR {
      for (std::size_t k = 0; k < 4; k += exact_lanes)
        hn::StoreU(keys_of(d, hn::LoadU(d, bits + from + k)), d, ends + to + k);
    };
    copy_four(0, 0);
    copy_four(2, 3);  // nothing is read behind the box
    out[i].id = records[i].id;
    out[i].before = records[i].before;
    out[i].hi[3] = INT64_MAX;
  }
  return out;
}

/// Whether two boxes overlap on all axes and this region owns the pair.
HWY_INLINE bool is_pair(const ExactRecord& x, const ExactRecord& y) {
  const DExact d;
  auto disjoint = hn::MaskFromVec(hn::Zero(d));
  for (std::size_t k = 0; k < 4; k += exact_lanes) {
    disjoint = hn::Or(disjoint, hn::Gt(hn::Load(d, x.lo + k), hn::Load(d, y.hi + k)));
    disjoint = hn::Or(disjoint, hn::Gt(hn::Load(d, y.lo + k), hn::Load(d, x.hi + k)));
  }
  return ((hn::AllFalse(d, disjoint) ? 1u : 0u) & ((x.before & y.before) == 0 ? 1u : 0u)) != 0;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#endif
