// SPDX-License-Identifier: MIT
//
// A search of a few boxes. Compiled once per SIMD target; the best one for the machine is picked at run time.

#include "search/small.hpp"

#include <algorithm>
#include <bit>

// Of eight boxes at a time: where masks are no vectors, to combine them takes longer than to compare.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_AVX3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/small.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Boxes compared with one other at a time. The same on every target, for it shows in the order of pairs.
constexpr std::size_t block = 8;
using D = hn::CappedTag<std::int32_t, block>;
constexpr std::size_t lanes = hn::MaxLanes(D());
constexpr std::size_t vectors = block / lanes;
using V = hn::VFromD<D>;
using M = decltype(hn::Gt(V(), V()));

/// Bit i: lane i.
HWY_INLINE std::uint64_t bits_of(M mask) {
  std::uint8_t bits[8];
  hn::StoreMaskBits(D(), mask, bits);
  return bits[0];
}

HWY_INLINE void overlap_nothing(SmallSet& set, std::size_t i) {
  for (int d = 0; d < 3; ++d) {
    set.lo[d][i] = INT32_MAX;
    set.hi[d][i] = INT32_MIN;
  }
}

template <class S>
void fill_one_by_one(Span<const BasicAabb<S>> boxes, SmallSet& set) {
  constexpr int dropped_bits = sizeof(S) == 8 ? 32 : 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (int d = 0; d < 3; ++d) {
      set.lo[d][i] = static_cast<std::int32_t>(order_key(boxes[i].min[d]) >> dropped_bits);
      set.hi[d][i] = static_cast<std::int32_t>(order_key(boxes[i].max[d]) >> dropped_bits);
    }
    if (has_valid_keys(boxes[i])) continue;
    overlap_nothing(set, i);
    ++set.invalid;
  }
}

#if HWY_TARGET != HWY_SCALAR

/// order_key of each lane.
HWY_INLINE V order_keys(V bits) {
  const D d;
  const auto keys = hn::Xor(bits, hn::And(hn::ShiftRight<31>(bits), hn::Set(d, INT32_MAX)));
  return hn::Sub(keys, hn::VecFromMask(d, hn::Eq(keys, hn::Set(d, -1))));  // -0, and nothing else, has become -1
}

/// Four bounds of every fourth box, as many as there are lanes, side by side.
template <class DV>
HWY_INLINE hn::Vec<DV> load_every_fourth(DV d, const float* bounds) {
  constexpr std::size_t bounds_of_box = 6;
  if constexpr (hn::MaxLanes(DV()) == 4) {
    return hn::LoadU(d, reinterpret_cast<const std::int32_t*>(bounds));
  } else {
    const hn::Half<DV> half;
    return hn::Combine(d, load_every_fourth(half, bounds + hn::MaxLanes(half) * bounds_of_box),
                       load_every_fourth(half, bounds));
  }
}

/// As many boxes as there are lanes, from `at` on. Returns which are invalid.
HWY_INLINE std::uint64_t fill_block(const Aabb* boxes, SmallSet& set, std::size_t at) {
  static_assert(sizeof(Aabb) == 24);
  const D d;
  const hn::RepartitionToWide<D> d64;
  const auto wide = [](auto v) { return hn::BitCast(hn::RepartitionToWide<D>(), v); };
  const auto keys = [](auto v) { return order_keys(hn::BitCast(D(), v)); };
  const auto row = [&](std::size_t i) { return load_every_fourth(D(), boxes[at + i].min); };
  const auto end_of_row = [&](std::size_t i) { return load_every_fourth(D(), boxes[at + i].min + 2); };
  const auto r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
  const auto low01 = wide(hn::InterleaveLower(d, r0, r1)), low23 = wide(hn::InterleaveLower(d, r2, r3));
  const auto up01 = wide(hn::InterleaveUpper(d, r0, r1)), up23 = wide(hn::InterleaveUpper(d, r2, r3));
  const auto end01 = wide(hn::InterleaveUpper(d, end_of_row(0), end_of_row(1)));
  const auto end23 = wide(hn::InterleaveUpper(d, end_of_row(2), end_of_row(3)));
  const V lo[3] = {keys(hn::InterleaveLower(d64, low01, low23)), keys(hn::InterleaveUpper(d64, low01, low23)),
                   keys(hn::InterleaveLower(d64, up01, up23))};
  const V hi[3] = {keys(hn::InterleaveUpper(d64, up01, up23)), keys(hn::InterleaveLower(d64, end01, end23)),
                   keys(hn::InterleaveUpper(d64, end01, end23))};
  for (int axis = 0; axis < 3; ++axis) {
    hn::StoreU(lo[axis], d, set.lo[axis] + at);
    hn::StoreU(hi[axis], d, set.hi[axis] + at);
  }
  const auto infinity = hn::Set(d, static_cast<std::int32_t>(infinity_key<float>));
  const auto beyond = hn::Or(hn::Gt(hn::Not(infinity), hn::Min(hn::Min(lo[0], lo[1]), lo[2])),
                             hn::Gt(hn::Max(hn::Max(hi[0], hi[1]), hi[2]), infinity));
  return bits_of(hn::Or(hn::Or(hn::Gt(lo[0], hi[0]), hn::Gt(lo[1], hi[1])), hn::Or(hn::Gt(lo[2], hi[2]), beyond)));
}

HWY_ATTR void FillSmall(Span<const Aabb> boxes, SmallSet& set) {
  const std::size_t size = boxes.size();
  if (size < lanes) return fill_one_by_one(boxes, set);
  for (std::size_t filled = 0; filled < size; filled += lanes) {
    const std::size_t at = std::min(filled, size - lanes);  // the last ones a second time, rather than any beyond
    const std::uint64_t invalid = fill_block(boxes.data(), set, at);
    if (HWY_LIKELY(invalid == 0)) continue;
    for (std::uint64_t left = invalid; left != 0; left &= left - 1)
      overlap_nothing(set, at + static_cast<std::size_t>(std::countr_zero(left)));
    set.invalid += static_cast<std::size_t>(std::popcount(invalid >> (filled - at)));
  }
}

#else

HWY_ATTR void FillSmall(Span<const Aabb> boxes, SmallSet& set) {
  fill_one_by_one(boxes, set);
}

#endif

HWY_ATTR void FillSmallDouble(Span<const Aabb64> boxes, SmallSet& set) {
  fill_one_by_one(boxes, set);
}

// So many rows of a block's lanes are a word. Of a block's own rows, those before each.
constexpr std::size_t rows_at_once = 64 / block;
constexpr std::uint64_t before_row = 0x7f3f1f0f07030100;
static_assert(rows_at_once == block);

HWY_ATTR bool CompareAll(const SmallSet& set, PairBuffer& pairs) {
  const D d;
  for (std::size_t at = 0; at < set.size; at += block) {
    V lo[3][vectors], hi[3][vectors];
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t k = 0; k < vectors; ++k) {
        lo[axis][k] = hn::Load(d, set.lo[axis] + at + k * lanes);
        hi[axis][k] = hn::Load(d, set.hi[axis] + at + k * lanes);
      }
    // A bit for each box of the block that overlaps that of the row.
    const auto overlapping = [&](std::size_t row) HWY_ATTR {
      std::uint64_t apart = 0;
      for (std::size_t k = 0; k < vectors; ++k) {
        const auto on = [&](std::size_t axis) HWY_ATTR {
          return hn::Or(hn::Gt(lo[axis][k], hn::Set(d, set.hi[axis][row])),
                        hn::Gt(hn::Set(d, set.lo[axis][row]), hi[axis][k]));
        };
        apart |= bits_of(hn::Or(hn::Or(on(0), on(1)), on(2))) << (k * lanes);
      }
      return apart ^ ((std::uint64_t{1} << block) - 1);
    };
    for (std::size_t first = at; first < set.size; first += rows_at_once) {
      const std::size_t rows = std::min(rows_at_once, set.size - first);
      std::uint64_t found = 0;
      for (std::size_t r = 0; r < rows; ++r) found |= overlapping(first + r) << (r * block);
      if (first == at) found &= before_row;
      Pair* out = pairs.end();
      for (; found != 0; found &= found - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(found));
        *out++ = {static_cast<std::uint32_t>(at + bit % block), static_cast<std::uint32_t>(first + bit / block)};
      }
      if (!pairs.keys_decide()) pairs.doubt(pairs.end(), out);
      pairs.set_end(out);
      if (HWY_UNLIKELY(out >= pairs.limit()) && !pairs.flush()) return false;
    }
  }
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(FillSmall);
HWY_EXPORT(FillSmallDouble);
HWY_EXPORT(CompareAll);

SmallSet::SmallSet(Span<const Aabb> boxes) : size(boxes.size()), invalid(0) {
  HWY_DYNAMIC_DISPATCH(FillSmall)(boxes, *this);
}

SmallSet::SmallSet(Span<const Aabb64> boxes) : size(boxes.size()), invalid(0) {
  HWY_DYNAMIC_DISPATCH(FillSmallDouble)(boxes, *this);
}

bool compare_all(const SmallSet& set, PairBuffer& pairs) {
  return HWY_DYNAMIC_DISPATCH(CompareAll)(set, pairs);
}

}  // namespace boxstream::detail
#endif
