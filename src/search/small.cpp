// SPDX-License-Identifier: MIT
//
// A search of a few boxes. Compiled once per SIMD target; the best one for the machine is picked at run time.

#include "search/small.hpp"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/small.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "search/sweep_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

/// So many boxes, up to a multiple of a block.
constexpr std::size_t whole_blocks(std::size_t size) {
  return (size + block - 1) / block * block;
}

/// For those of the boxes from `at` on that have a bit.
HWY_INLINE void overlap_nothing(SmallSet& set, std::size_t at, std::uint32_t invalid) {
  for (; invalid != 0; invalid &= invalid - 1) {
    const std::size_t i = at + static_cast<std::size_t>(std::countr_zero(invalid));
    for (int d = 0; d < 3; ++d) {
      set.lo[d][i] = INT32_MAX;
      set.hi[d][i] = INT32_MIN;
    }
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

/// Four bounds, from `offset` on, of every fourth box: those of `at`, `at` + 4 and so on side by side, as many as there
/// are lanes. The last box stands in for those beyond.
template <class DV>
HWY_INLINE hn::Vec<DV> load_every_fourth(DV d, Span<const Aabb> boxes, std::size_t at, std::size_t offset) {
  if constexpr (hn::MaxLanes(DV()) == 4) {
    const auto* box = reinterpret_cast<const std::int32_t*>(&boxes[std::min(at, boxes.size() - 1)]);
    return hn::LoadU(d, box + offset);
  } else {
    const hn::Half<DV> half;
    return hn::Combine(d, load_every_fourth(half, boxes, at + hn::MaxLanes(half), offset),
                       load_every_fourth(half, boxes, at, offset));
  }
}

HWY_ATTR void FillSmall(Span<const Aabb> boxes, SmallSet& set) {
  static_assert(sizeof(Aabb) == 24);
  const D d;
  const hn::RepartitionToWide<D> d64;
  const auto infinity = hn::Set(d, static_cast<std::int32_t>(infinity_key<float>));
  const auto minus_infinity = hn::Not(infinity);
  const auto wide = [&](auto v) { return hn::BitCast(d64, v); };
  const auto narrow = [&](auto v) { return order_keys(hn::BitCast(d, v)); };
  const std::size_t size = boxes.size();
  for (std::size_t at = 0; at < whole_blocks(size); at += lanes) {
    V row[4];
    for (std::size_t i = 0; i < 4; ++i) row[i] = load_every_fourth(d, boxes, at + i, 0);
    const auto low01 = wide(hn::InterleaveLower(d, row[0], row[1])),
               low23 = wide(hn::InterleaveLower(d, row[2], row[3]));
    const auto up01 = wide(hn::InterleaveUpper(d, row[0], row[1])), up23 = wide(hn::InterleaveUpper(d, row[2], row[3]));
    for (std::size_t i = 0; i < 4; ++i) row[i] = load_every_fourth(d, boxes, at + i, 2);
    const auto end01 = wide(hn::InterleaveUpper(d, row[0], row[1])),
               end23 = wide(hn::InterleaveUpper(d, row[2], row[3]));
    const auto lo0 = narrow(hn::InterleaveLower(d64, low01, low23)),
               lo1 = narrow(hn::InterleaveUpper(d64, low01, low23));
    const auto lo2 = narrow(hn::InterleaveLower(d64, up01, up23)), hi0 = narrow(hn::InterleaveUpper(d64, up01, up23));
    const auto hi1 = narrow(hn::InterleaveLower(d64, end01, end23)),
               hi2 = narrow(hn::InterleaveUpper(d64, end01, end23));
    hn::Store(lo0, d, set.lo[0] + at);
    hn::Store(lo1, d, set.lo[1] + at);
    hn::Store(lo2, d, set.lo[2] + at);
    hn::Store(hi0, d, set.hi[0] + at);
    hn::Store(hi1, d, set.hi[1] + at);
    hn::Store(hi2, d, set.hi[2] + at);
    const auto wrong = hn::Or(hn::Or(hn::Gt(lo0, hi0), hn::Gt(lo1, hi1)),
                              hn::Or(hn::Gt(lo2, hi2), hn::Or(hn::Gt(minus_infinity, hn::Min(hn::Min(lo0, lo1), lo2)),
                                                              hn::Gt(hn::Max(hn::Max(hi0, hi1), hi2), infinity))));
    if (HWY_UNLIKELY(!hn::AllFalse(d, wrong))) {
      const std::size_t left = size - std::min(size, at);
      const std::uint32_t in_set = left < lanes ? (std::uint32_t{1} << left) - 1 : ~std::uint32_t{0};
      overlap_nothing(set, at, bits_of(hn::RebindMask(DU(), wrong)) & in_set);
    }
  }
}

#else

HWY_ATTR void FillSmall(Span<const Aabb> boxes, SmallSet& set) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (int d = 0; d < 3; ++d) {
      set.lo[d][i] = order_key(boxes[i].min[d]);
      set.hi[d][i] = order_key(boxes[i].max[d]);
    }
    if (!has_valid_keys(boxes[i])) overlap_nothing(set, i, 1);
  }
}

#endif

// So many rows of a block's lanes are a word.
constexpr std::size_t rows_at_once = 64 / block;
// Of a block's own rows, the lanes before each.
constexpr std::uint64_t before_row[block / rows_at_once] = {0x0007000300010000, 0x007f003f001f000f, 0x07ff03ff01ff00ff,
                                                            0x7fff3fff1fff0fff};

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
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < vectors; ++k) {
        const auto apart = [&](std::size_t axis) HWY_ATTR {
          return hn::Or(hn::Gt(lo[axis][k], hn::Set(d, set.hi[axis][row])),
                        hn::Gt(hn::Set(d, set.lo[axis][row]), hi[axis][k]));
        };
        bits |= bits_of(hn::RebindMask(DU(), hn::Not(hn::Or(hn::Or(apart(0), apart(1)), apart(2))))) << (k * lanes);
      }
      return std::uint64_t{bits};
    };
    for (std::size_t first = at; first < set.size; first += rows_at_once) {
      std::uint64_t found = 0;
      for (std::size_t r = 0; r < rows_at_once; ++r) found |= overlapping(first + r) << (r * block);
      if (first < at + block) found &= before_row[(first - at) / rows_at_once];
      if (set.size - first < rows_at_once) found &= (std::uint64_t{1} << (set.size - first) * block) - 1;
      Pair* out = pairs.end();
      for (; found != 0; found &= found - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(found));
        *out++ = {static_cast<std::uint32_t>(at + bit % block), static_cast<std::uint32_t>(first + bit / block)};
      }
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
HWY_EXPORT(CompareAll);

SmallSet::SmallSet(Span<const Aabb> boxes) : size(boxes.size()), invalid(0) {
  HWY_DYNAMIC_DISPATCH(FillSmall)(boxes, *this);
}

SmallSet::SmallSet(Span<const Aabb64> boxes) : size(boxes.size()), invalid(0) {
  for (std::size_t i = 0; i < size; ++i) {
    const bool valid = has_valid_keys(boxes[i]);
    invalid += valid ? 0 : 1;
    for (int d = 0; d < 3; ++d) {
      lo[d][i] = valid ? static_cast<std::int32_t>(order_key(boxes[i].min[d]) >> 32) : INT32_MAX;
      hi[d][i] = valid ? static_cast<std::int32_t>(order_key(boxes[i].max[d]) >> 32) : INT32_MIN;
    }
  }
}

bool compare_all(const SmallSet& set, PairBuffer& pairs) {
  return HWY_DYNAMIC_DISPATCH(CompareAll)(set, pairs);
}

}  // namespace boxstream::detail
#endif
