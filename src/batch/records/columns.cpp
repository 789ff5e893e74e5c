// SPDX-License-Identifier: MIT
//
// Two sets are looked at by blocks of boxes, each bound a column. Compiled once per SIMD target; the best one for the
// machine is picked at run time.

#include "batch/records/columns.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/records/columns.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "batch/records/columns_load-inl.hpp"
#include "batch/records/sweep_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

static_assert(lane_group == block && load_block % block == 0 && load_block <= PairBuffer::slack);

/// Bounds of a block's boxes, or of as many of them as fit.
template <class Key>
using Wide = hn::CappedTag<Key, block>;

/// The bits of the bounds of as many boxes as there are lanes, in the order of an Aabb.
template <class DK>
HWY_INLINE void deinterleave(DK d, const Aabb* boxes, hn::VFromD<DK> (&bounds)[6]) {
#if HWY_TARGET == HWY_SCALAR
  deinterleave_few(d, boxes, 0, bounds);
#else
  // Of a box, two bounds are a word: words apart first, then their halves.
  const hn::Repartition<std::int64_t, DK> d64;
  hn::VFromD<decltype(d64)> low[3], high[3];
  const auto* words = reinterpret_cast<const std::int64_t*>(boxes);
  hn::LoadInterleaved3(d64, words, low[0], low[1], low[2]);
  hn::LoadInterleaved3(d64, words + 3 * hn::MaxLanes(d64), high[0], high[1], high[2]);
  for (int i = 0; i < 3; ++i) {
    bounds[2 * i] = hn::ConcatEven(d, hn::BitCast(d, high[i]), hn::BitCast(d, low[i]));
    bounds[2 * i + 1] = hn::ConcatOdd(d, hn::BitCast(d, high[i]), hn::BitCast(d, low[i]));
  }
#endif
}

template <class DK>
HWY_INLINE void deinterleave(DK d, const Aabb64* boxes, hn::VFromD<DK> (&bounds)[6]) {
  deinterleave_few(d, boxes, hn::MaxLanes(d), bounds);
}

// In bytes: two blocks of floats.
constexpr std::size_t prefetch_ahead = 3072;

template <class S, class Key>
HWY_INLINE std::uint64_t load_all(const BasicAabb<S>* boxes, std::size_t count, Faces faces, BoxColumnsOf<Key>& out) {
  const Wide<Key> d;
  constexpr std::size_t step = hn::MaxLanes(d);
  std::uint64_t valid = 0;
  std::size_t at = 0;
  for (; at + step <= count; at += step) {
    for (std::size_t byte = 0; byte < step * sizeof(boxes[0]); byte += 64)
      hwy::Prefetch(reinterpret_cast<const char*>(boxes + at) + prefetch_ahead + byte);
    hn::VFromD<Wide<Key>> bounds[6];
    deinterleave(d, boxes + at, bounds);
    valid |= std::uint64_t{store_keys(d, bounds, step, at, faces, out)} << at;
  }
  if (count % lane_group == 0) return valid;
  const std::size_t last_group = count / lane_group * lane_group;
  const std::size_t none_from = std::max(at, last_group);
  std::fill(out.lo[0] + none_from, out.lo[0] + last_group + lane_group, std::numeric_limits<Key>::max());
  return valid | load_few(boxes, at, count, faces, out);
}

HWY_ATTR std::uint64_t LoadColumns(const Aabb* boxes, std::size_t count, Faces faces, BoxColumns& out) {
  return load_all(boxes, count, faces, out);
}

using DF = hn::CappedTag<float, block>;

/// Positions of as many keys as there are lanes, along the line on which cells are even.
HWY_INLINE hn::VFromD<DF> positions_of(V key, const CellGrid::Axis& axis) {
  const DF d;
  if (!axis.are_floats) return hn::ConvertTo(d, key);
  return hn::BitCast(d, hn::Xor(key, hn::And(hn::BroadcastSignBit(key), hn::Set(D(), INT32_MAX))));
}

/// The cells of as many keys as there are lanes.
HWY_INLINE V cells_of(V key, const CellGrid::Axis& axis) {
  const D d;
  const DF df;
  const V within = hn::Min(hn::Max(key, hn::Set(d, axis.from)), hn::Set(d, axis.to));
  const auto distance = hn::Sub(positions_of(within, axis), hn::Set(df, axis.origin));
  // A sum with 2^23 is rounded to an integer, which its last bits hold.
  constexpr std::int32_t bits_of_2_to_23 = 0x4b000000;
  const auto rounded = hn::Add(hn::Mul(distance, hn::Set(df, axis.scale)), hn::Set(df, 8388608.0f));
  const V cell = hn::Sub(hn::BitCast(d, rounded), hn::Set(d, bits_of_2_to_23 - 1));
  return hn::IfThenElse(hn::Gt(key, hn::Set(d, axis.max)), hn::Set(d, axis.last_cell),
                        hn::IfThenZeroElse(hn::Lt(key, hn::Set(d, axis.min)), cell));
}

/// The bits of the cells from first to last.
HWY_INLINE void mark_x(const std::uint8_t* first, const std::uint8_t* last, std::uint64_t* x) {
  const hn::CappedTag<std::uint64_t, 8> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  const auto ones = hn::Set(d, ~std::uint64_t{0}), highest = hn::Set(d, CellGrid::cells_in_x - 1);
  const auto widened = [&](const std::uint8_t* bytes) {
    return hn::PromoteTo(d, hn::PromoteTo(hn::Rebind<std::uint32_t, decltype(d)>(), hn::LoadU(d8, bytes)));
  };
  for (std::size_t i = 0; i < load_block; i += hn::MaxLanes(d))
    hn::StoreU(hn::And(hn::Shl(ones, widened(first + i)), hn::Shr(ones, hn::Sub(highest, widened(last + i)))), d,
               x + i);
}

HWY_ATTR void LocateCells(const BoxColumns& boxes, const CellGrid& grid, CellColumns& out) {
  const D d;
  const hn::Rebind<std::uint8_t, D> d8;
  const V one = hn::Set(d, 1), next_z = hn::Set(d, static_cast<std::int32_t>(grid.cells + 2));
  const V rows = hn::Set(d, static_cast<std::int32_t>(CellGrid::rows(grid.cells)));
  out.wide = 0;
  for (std::size_t at = 0; at < load_block; at += lanes) {
    V first[3], more[3];
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = cells_of(hn::Load(d, boxes.lo[axis] + at), grid.axes[axis]);
      // A flat open box ends before it begins, and so does a lane without a box.
      const V last = hn::Max(first[axis], cells_of(hn::Load(d, boxes.hi[axis] + at), grid.axes[axis]));
      more[axis] = hn::Sub(last, first[axis]);
      hn::StoreU(hn::DemoteTo(d8, first[axis]), d8, out.first[axis] + at);
      hn::StoreU(hn::DemoteTo(d8, last), d8, out.last[axis] + at);
    }
    const M is_wide = hn::Ne(hn::ShiftRight<1>(hn::Or(more[1], more[2])), hn::Zero(d));
    const V row = hn::Add(hn::Mul(hn::Add(first[2], one), next_z), hn::Add(first[1], one));
    const V layer = hn::Mul(hn::Add(more[1], hn::Add(more[2], more[2])), rows);
    hn::StoreU(hn::IfThenZeroElse(is_wide, hn::Add(row, layer)), d, reinterpret_cast<std::int32_t*>(out.row) + at);
    out.wide |= std::uint64_t{bits_of(d, is_wide)} << at;
  }
  mark_x(out.first[0], out.last[0], out.x);
}

HWY_ATTR std::uint64_t FindMarked(const CellColumns& boxes, const std::uint64_t* words) {
  const hn::CappedTag<std::int64_t, 8> d;
  const hn::Rebind<std::uint32_t, decltype(d)> d32;
  const hn::RebindToUnsigned<decltype(d)> du;
  std::uint64_t marked = 0;
  for (std::size_t i = 0; i < load_block; i += hn::MaxLanes(d)) {
    const auto rows = hn::BitCast(d, hn::PromoteTo(du, hn::LoadU(d32, boxes.row + i)));
    const auto found = hn::And(hn::GatherIndex(du, words, rows), hn::LoadU(du, boxes.x + i));
    marked |= std::uint64_t{bits_of(du, hn::Ne(found, hn::Zero(du)))} << i;
  }
  return marked;
}

/// The mask of as many of the lanes of a vector of indices.
template <class DK>
HWY_INLINE MU hits_of(DK d, typename Bounds<DK>::Mask disjoint) {
  const DU du;
  if constexpr (sizeof(hn::TFromD<DK>) == 4) {
    return hn::Not(hn::RebindMask(du, disjoint));
  } else {
    const std::uint8_t bits[8] = {static_cast<std::uint8_t>(bits_of(d, hn::Not(disjoint)))};
    return hn::LoadMaskBits(du, bits);
  }
}

/// Emits the pairs of each of the few, in their order, with the boxes of a block up to `end`, in theirs.
template <class Key>
HWY_INLINE bool compare_block(const BoxColumnsOf<Key>* few, std::uint32_t few_size, const BoxColumnsOf<Key>& many,
                              std::size_t end, std::uint32_t first_id, bool few_first, PairBuffer& pairs) {
  const Wide<Key> d;
  const DU du;
  constexpr std::size_t step = hn::MaxLanes(d);
  for (std::uint32_t i = 0; i < few_size; ++i) {
    Bounds<Wide<Key>> one, others;
    one.repeat(few[i / load_block], i % load_block);
    typename Bounds<Wide<Key>>::Mask disjoint[load_block / step];
    others.load(many, 0);
    auto all_disjoint = disjoint[0] = one.disjoint(others);
    for (std::size_t v = 1; v < end / step; ++v) {
      others.load(many, v * step);
      disjoint[v] = one.disjoint(others);
      all_disjoint = hn::And(all_disjoint, disjoint[v]);
    }
    if (HWY_LIKELY(hn::AllTrue(d, all_disjoint))) continue;
    const auto id = hn::Set(du, i);
    Pair* out = pairs.end();
    for (std::size_t v = 0; v < end / step; ++v) {
      const auto hit = hits_of(d, disjoint[v]);
      const std::size_t count = hn::CountTrue(du, hit);
      if (count == 0) continue;
      const auto found =
          compressed(du, hn::Add(hn::Iota(du, 0), hn::Set(du, first_id + static_cast<std::uint32_t>(v * step))), hit);
      if (few_first)
        store(id, found, count, out);
      else
        store(found, id, count, out);
      out += count;
    }
    pairs.set_end(out);
    if (HWY_UNLIKELY(out >= pairs.limit()) && !pairs.flush()) return false;
  }
  return true;
}

constexpr std::size_t blocks_of_few = (thresholds.most_few + load_block - 1) / load_block;

template <class S>
HWY_INLINE bool compare_sets(Span<const BasicAabb<S>> few, Span<const BasicAabb<S>> many, Faces faces, bool few_first,
                             PairBuffer& pairs, FewAndMany& valid) {
  using Key = decltype(order_key(S()));
  const auto few_size = static_cast<std::uint32_t>(few.size());
  BoxColumnsOf<Key> columns_of_few[blocks_of_few], columns;
  const auto load = [faces](Span<const BasicAabb<S>> boxes, std::size_t begin, BoxColumnsOf<Key>& out) HWY_ATTR {
    return std::popcount(load_all(boxes.data() + begin, std::min(load_block, boxes.size() - begin), faces, out));
  };
  for (std::size_t begin = 0; begin < few.size(); begin += load_block)
    valid.few += static_cast<std::size_t>(load(few, begin, columns_of_few[begin / load_block]));
  for (std::size_t begin = 0; begin < many.size(); begin += load_block) {
    valid.many += static_cast<std::size_t>(load(many, begin, columns));
    const auto first_id = static_cast<std::uint32_t>(begin);
    const auto compare = [&](std::size_t end) HWY_ATTR {
      return compare_block(columns_of_few, few_size, columns, end, first_id, few_first, pairs);
    };
    const std::size_t left = many.size() - begin;  // most blocks are whole, so that the compiler knows the end
    if (!(left >= load_block ? compare(load_block) : compare((left + block - 1) / block * block))) return false;
  }
  return true;
}

HWY_ATTR bool CompareFew(Span<const Aabb> few, Span<const Aabb> many, Faces faces, bool few_first, PairBuffer& pairs,
                         FewAndMany& valid) {
  return compare_sets(few, many, faces, few_first, pairs, valid);
}
HWY_ATTR bool CompareFew64(Span<const Aabb64> few, Span<const Aabb64> many, Faces faces, bool few_first,
                           PairBuffer& pairs, FewAndMany& valid) {
  return compare_sets(few, many, faces, few_first, pairs, valid);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(LoadColumns);
HWY_EXPORT(LocateCells);
HWY_EXPORT(FindMarked);
HWY_EXPORT(CompareFew);
HWY_EXPORT(CompareFew64);

std::uint64_t load_columns(const Aabb* boxes, std::size_t count, Faces faces, BoxColumns& out) {
  assert(count <= load_block);
  return HWY_DYNAMIC_DISPATCH(LoadColumns)(boxes, count, faces, out);
}

void load_columns(const Record* records, std::size_t count, std::uint64_t valid, BoxColumns& out) {
  assert(count <= load_block && (count == load_block || valid >> count == 0));
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < count; ++i) {
      out.lo[axis][i] = records[i].lo[axis];
      out.hi[axis][i] = records[i].hi[axis];
    }
  for (std::size_t i = 0; i < load_block; ++i)
    if ((valid >> i & 1) == 0) out.lo[0][i] = INT32_MAX;
}

CellGrid::Axis::Axis(KeyKind kind, std::int32_t min_key, std::int32_t max_key, std::int32_t from_key,
                     std::int32_t to_key, unsigned cells)
    : min(min_key),
      max(max_key),
      are_floats(kind == KeyKind::float32),
      last_cell(static_cast<std::int32_t>(cells) - 1) {
  assert(min <= max && from_key <= to_key && cells > 3);
  // So that distances are finite.
  const std::int32_t farthest = are_floats ? order_key(1e38f) : INT32_MAX;
  from = std::clamp(from_key, -farthest, farthest);
  to = std::clamp(to_key, from, farthest);
  const auto position = [&](std::int32_t key) {
    return are_floats ? std::bit_cast<float>(key ^ ((key >> 31) & INT32_MAX)) : static_cast<float>(key);
  };
  origin = position(from);
  const float cells_inside = static_cast<float>(cells - 3) + 0.49f;  // of which the last is half as large
  scale = std::min(cells_inside / (position(to) - origin), std::numeric_limits<float>::max());
}

std::uint64_t CellColumns::inside(const CellGrid& grid) const {
  std::uint64_t boxes = 0;
  for (std::size_t i = 0; i < load_block; ++i) {
    bool is_inside = true;
    for (int d = 0; d < 3; ++d) is_inside &= last[d][i] != 0 && first[d][i] < grid.axes[d].last_cell;
    boxes |= std::uint64_t{is_inside} << i;
  }
  return boxes;
}

void locate_cells(const BoxColumns& boxes, const CellGrid& grid, CellColumns& out) {
  HWY_DYNAMIC_DISPATCH(LocateCells)(boxes, grid, out);
}

std::uint64_t find_marked(const CellColumns& boxes, const std::uint64_t* words) {
  return HWY_DYNAMIC_DISPATCH(FindMarked)(boxes, words);
}

bool compare_few(Span<const Aabb> few, Span<const Aabb> many, Faces faces, bool few_first, PairBuffer& pairs,
                 FewAndMany& valid) {
  assert(few.size() <= thresholds.most_few);
  return HWY_DYNAMIC_DISPATCH(CompareFew)(few, many, faces, few_first, pairs, valid);
}

bool compare_few(Span<const Aabb64> few, Span<const Aabb64> many, Faces faces, bool few_first, PairBuffer& pairs,
                 FewAndMany& valid) {
  assert(few.size() <= thresholds.most_few);
  return HWY_DYNAMIC_DISPATCH(CompareFew64)(few, many, faces, few_first, pairs, valid);
}

}  // namespace boxstream::detail
#endif
