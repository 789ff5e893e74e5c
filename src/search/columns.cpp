// SPDX-License-Identifier: MIT
//
// Two sets are looked at by blocks of boxes, each bound a column. Compiled once per SIMD target; the best one for the
// machine is picked at run time.

#include "search/columns.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/columns.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "search/sweep_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

static_assert(load_block % block == 0 && load_block <= PairBuffer::slack);

/// order_key of each lane.
HWY_INLINE V keys_of(V bits) {
  const D d;
  const auto keys = hn::Xor(bits, hn::And(hn::ShiftRight<31>(bits), hn::Set(d, INT32_MAX)));
  return hn::Sub(keys, hn::VecFromMask(d, hn::Eq(keys, hn::Set(d, -1))));  // -0, and nothing else, has become -1
}

/// The bounds of as many boxes as there are lanes, in the order of an Aabb.
HWY_INLINE void take_apart(const Aabb* boxes, V (&bounds)[6]) {
  const auto* bits = reinterpret_cast<const std::int32_t*>(boxes);
#if HWY_TARGET == HWY_SCALAR
  for (int i = 0; i < 6; ++i) bounds[i] = hn::LoadU(D(), bits + i);
#else
  // Of a box, two bounds are a word: words apart first, then their halves.
  const D d;
  const hn::Repartition<std::int64_t, D> d64;
  hn::VFromD<decltype(d64)> low[3], high[3];
  const auto* words = reinterpret_cast<const std::int64_t*>(bits);
  hn::LoadInterleaved3(d64, words, low[0], low[1], low[2]);
  hn::LoadInterleaved3(d64, words + 3 * lanes / 2, high[0], high[1], high[2]);
  for (int i = 0; i < 3; ++i) {
    bounds[2 * i] = hn::ConcatEven(d, hn::BitCast(d, high[i]), hn::BitCast(d, low[i]));
    bounds[2 * i + 1] = hn::ConcatOdd(d, hn::BitCast(d, high[i]), hn::BitCast(d, low[i]));
  }
#endif
}

HWY_ATTR std::uint64_t LoadColumns(const Aabb* boxes, BoxColumns& out) {
  static_assert(sizeof(Aabb) == 24);
  const D d;
  const auto infinity = hn::Set(d, static_cast<std::int32_t>(infinity_key<float>));
  std::uint64_t all_valid = 0;
  for (std::size_t at = 0; at < load_block; at += lanes) {
    V key[6];
    take_apart(boxes + at, key);
    for (V& k : key) k = keys_of(k);
    const auto lowest = hn::Min(hn::Min(key[0], key[1]), key[2]), highest = hn::Max(hn::Max(key[3], key[4]), key[5]);
    const auto beyond = hn::Or(hn::Gt(hn::Not(infinity), lowest), hn::Gt(highest, infinity));
    const auto inverted = hn::Or(hn::Or(hn::Gt(key[0], key[3]), hn::Gt(key[1], key[4])), hn::Gt(key[2], key[5]));
    const auto wrong = hn::Or(beyond, inverted);
    key[0] = hn::IfThenElse(wrong, hn::Set(d, INT32_MAX), key[0]);
    for (int axis = 0; axis < 3; ++axis) {
      hn::Store(key[axis], d, out.lo[axis] + at);
      hn::Store(key[3 + axis], d, out.hi[axis] + at);
    }
    all_valid |= std::uint64_t{bits_of(hn::RebindMask(DU(), hn::Not(wrong)))} << at;
  }
  return all_valid;
}

HWY_ATTR void LocateCells(const BoxColumns& boxes, const CellGrid& grid, CellColumns& out) {
  for (int axis = 0; axis < 3; ++axis) {
    const CellGrid::Axis cell = grid.axes[axis];  // so that the loops keep it in registers
    const std::int32_t* HWY_RESTRICT lo = boxes.lo[axis];
    const std::int32_t* HWY_RESTRICT hi = boxes.hi[axis];
    std::uint8_t* HWY_RESTRICT first = out.first[axis];
    std::uint8_t* HWY_RESTRICT last = out.last[axis];
    for (std::size_t i = 0; i < load_block; ++i) first[i] = static_cast<std::uint8_t>(cell(lo[i]));
    for (std::size_t i = 0; i < load_block; ++i) last[i] = static_cast<std::uint8_t>(cell(hi[i]));
  }
  constexpr std::uint64_t ones = ~std::uint64_t{0};
  for (std::size_t i = 0; i < load_block; ++i)
    out.x[i] = ones << out.first[0][i] & ones >> (CellGrid::cells_in_x - 1 - out.last[0][i]);
  const unsigned cells = grid.cells;
  const auto rows = static_cast<std::uint32_t>(CellGrid::rows(cells));
  std::uint8_t wide[load_block];
  for (std::size_t i = 0; i < load_block; ++i) {
    const std::uint32_t y = out.first[1][i], z = out.first[2][i];
    const std::uint32_t more_y = out.last[1][i] - y, more_z = out.last[2][i] - z;
    const bool is_wide = (more_y | more_z) > 1;
    wide[i] = is_wide;
    out.row[i] = is_wide ? 0 : CellGrid::row_of(y, z, cells) + (more_y + 2 * more_z) * rows;
  }
  out.wide = 0;
  for (std::size_t i = 0; i < load_block; ++i) out.wide |= std::uint64_t{wide[i]} << i;
}

/// One of the few, each bound in all lanes.
struct One {
  V lo[3], hi[3];

  HWY_INLINE M apart(const BoxColumns& many, std::size_t at) const {
    const D d;
    const auto on = [&](int axis) {
      return hn::Or(hn::Gt(hn::Load(d, many.lo[axis] + at), hi[axis]),
                    hn::Gt(lo[axis], hn::Load(d, many.hi[axis] + at)));
    };
    return hn::Or(hn::Or(on(0), on(1)), on(2));
  }
};

template <bool few_first>
HWY_INLINE Pair* put_hits(const One& one, std::uint32_t id, const BoxColumns& many, std::uint32_t first_id, Pair* out) {
  const DU du;
  for (std::size_t at = 0; at < load_block; at += lanes) {
    const auto hit = hn::Not(hn::RebindMask(du, one.apart(many, at)));
    const std::size_t count = hn::CountTrue(du, hit);
    if (count == 0) continue;
    const auto found = hn::Compress(hn::Iota(du, first_id + static_cast<std::uint32_t>(at)), hit);
    const auto same = hn::Set(du, id);
    store(few_first ? same : found, few_first ? found : same, count, out);
    out += count;
  }
  return out;
}

template <bool few_first>
HWY_ATTR bool compare_all_few(const FewBoxes& few, const BoxColumns& many, std::uint32_t first_id, PairBuffer& pairs) {
  const D d;
  for (std::uint64_t left = few.valid; left != 0; left &= left - 1) {
    const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
    One one;
    for (int axis = 0; axis < 3; ++axis) {
      one.lo[axis] = hn::Set(d, few.columns.lo[axis][i]);
      one.hi[axis] = hn::Set(d, few.columns.hi[axis][i]);
    }
    auto apart = one.apart(many, 0);
    for (std::size_t at = lanes; at < load_block; at += lanes) apart = hn::And(apart, one.apart(many, at));
    if (HWY_LIKELY(hn::AllTrue(d, apart))) continue;
    pairs.set_end(put_hits<few_first>(one, few.first_id + i, many, first_id, pairs.end()));
    if (HWY_UNLIKELY(pairs.end() >= pairs.limit()) && !pairs.flush()) return false;
  }
  return true;
}

HWY_ATTR bool CompareFew(const FewBoxes& few, const BoxColumns& many, std::uint32_t first_id, bool few_first,
                         PairBuffer& pairs) {
  return few_first ? compare_all_few<true>(few, many, first_id, pairs)
                   : compare_all_few<false>(few, many, first_id, pairs);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(LoadColumns);
HWY_EXPORT(LocateCells);
HWY_EXPORT(CompareFew);

std::uint64_t load_columns(const Aabb* boxes, std::size_t count, BoxColumns& out) {
  if (count == load_block) return HWY_DYNAMIC_DISPATCH(LoadColumns)(boxes, out);
  Aabb padded[load_block];
  Aabb* const end = std::copy_n(boxes, count, padded);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  std::fill(end, padded + load_block, Aabb{{nan, nan, nan}, {nan, nan, nan}});
  return HWY_DYNAMIC_DISPATCH(LoadColumns)(padded, out);
}

void load_columns(const Record* records, std::size_t count, std::uint64_t valid, BoxColumns& out) {
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < count; ++i) {
      out.lo[axis][i] = records[i].lo[axis];
      out.hi[axis][i] = records[i].hi[axis];
    }
  for (std::size_t i = 0; i < load_block; ++i)
    if ((valid >> i & 1) == 0) out.lo[0][i] = INT32_MAX;
}

std::uint64_t CellColumns::inside(const CellGrid& grid) const {
  std::uint64_t boxes = 0;
  for (std::size_t i = 0; i < load_block; ++i) {
    bool is_inside = true;
    for (int d = 0; d < 3; ++d) is_inside &= last[d][i] != 0 && first[d][i] <= grid.axes[d].inside.count();
    boxes |= std::uint64_t{is_inside} << i;
  }
  return boxes;
}

void locate_cells(const BoxColumns& boxes, const CellGrid& grid, CellColumns& out) {
  HWY_DYNAMIC_DISPATCH(LocateCells)(boxes, grid, out);
}

bool compare_few(const FewBoxes& few, const BoxColumns& block, std::uint32_t first_id, bool few_first,
                 PairBuffer& pairs) {
  return HWY_DYNAMIC_DISPATCH(CompareFew)(few, block, first_id, few_first, pairs);
}

}  // namespace boxstream::detail
#endif
