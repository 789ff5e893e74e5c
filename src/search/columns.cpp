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
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "search/sweep_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

static_assert(lane_group == block && load_block % block == 0 && load_block <= PairBuffer::slack);

template <class Key>
using Tag = hn::CappedTag<Key, block>;
template <class Key>
using Vec = hn::VFromD<Tag<Key>>;
template <class Key>
constexpr std::size_t lanes_of = hn::MaxLanes(Tag<Key>());

template <class Key>
using MaskOf = decltype(hn::Gt(Vec<Key>(), Vec<Key>()));

/// Bit i: lane i.
template <class Key>
HWY_INLINE std::uint32_t bits_of_mask(MaskOf<Key> mask) {
  std::uint8_t bits[8] = {};  // as many as are written
  hn::StoreMaskBits(Tag<Key>(), mask, bits);
  return lanes_of<Key> > 8 ? bits[0] | std::uint32_t{bits[1]} << 8 : bits[0];
}

/// order_key of each lane.
template <class Key>
HWY_INLINE Vec<Key> keys_of(Vec<Key> bits) {
  const Tag<Key> d;
  const auto keys = hn::Xor(bits, hn::And(hn::BroadcastSignBit(bits), hn::Set(d, std::numeric_limits<Key>::max())));
  return hn::Sub(keys, hn::VecFromMask(d, hn::Eq(keys, hn::Set(d, Key{-1}))));  // -0, and nothing else, has become -1
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

HWY_INLINE void take_apart(const Aabb64* boxes, Vec<std::int64_t> (&bounds)[6]) {
  const Tag<std::int64_t> d;
  const auto* bits = reinterpret_cast<const std::int64_t*>(boxes);
  const auto lane = hn::Iota(d, 0), offset = hn::Add(hn::ShiftLeft<2>(lane), hn::ShiftLeft<1>(lane));
  for (int i = 0; i < 6; ++i) bounds[i] = hn::GatherIndex(d, bits + i, offset);
}

// In bytes: two blocks of floats.
constexpr std::size_t prefetch_ahead = 3072;

/// Of a multiple of lane_group boxes.
template <class S, class Key>
HWY_INLINE std::uint64_t load_all(const BasicAabb<S>* boxes, std::size_t count, BoxColumnsOf<Key>& out) {
  static_assert(sizeof(BasicAabb<S>) == 6 * sizeof(Key));
  const Tag<Key> d;
  const auto infinity = hn::Set(d, static_cast<Key>(infinity_key<S>));
  std::uint64_t all_valid = 0;
  for (std::size_t at = 0; at < count; at += lanes_of<Key>) {
    for (std::size_t byte = 0; byte < lanes_of<Key> * sizeof(boxes[0]); byte += 64)
      hwy::Prefetch(reinterpret_cast<const char*>(boxes + at) + prefetch_ahead + byte);
    Vec<Key> key[6];
    take_apart(boxes + at, key);
    for (auto& k : key) k = keys_of<Key>(k);
    const auto lowest = hn::Min(hn::Min(key[0], key[1]), key[2]), highest = hn::Max(hn::Max(key[3], key[4]), key[5]);
    const auto beyond = hn::Or(hn::Gt(hn::Not(infinity), lowest), hn::Gt(highest, infinity));
    const auto inverted = hn::Or(hn::Or(hn::Gt(key[0], key[3]), hn::Gt(key[1], key[4])), hn::Gt(key[2], key[5]));
    const auto wrong = hn::Or(beyond, inverted);
    key[0] = hn::IfThenElse(wrong, hn::Set(d, std::numeric_limits<Key>::max()), key[0]);
    for (int axis = 0; axis < 3; ++axis) {
      hn::Store(key[axis], d, out.lo[axis] + at);
      hn::Store(key[3 + axis], d, out.hi[axis] + at);
    }
    all_valid |= std::uint64_t{bits_of_mask<Key>(hn::Not(wrong))} << at;
  }
  return all_valid;
}

HWY_ATTR std::uint64_t LoadColumns(const Aabb* boxes, std::size_t count, BoxColumns& out) {
  return load_all<float, std::int32_t>(boxes, count, out);
}
HWY_ATTR std::uint64_t LoadColumns64(const Aabb64* boxes, std::size_t count, BoxColumnsOf<std::int64_t>& out) {
  return load_all<double, std::int64_t>(boxes, count, out);
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

/// A bit for each of the cells from first to last.
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
      const V last = cells_of(hn::Load(d, boxes.hi[axis] + at), grid.axes[axis]);
      more[axis] = hn::Sub(last, first[axis]);
      hn::StoreU(hn::DemoteTo(d8, first[axis]), d8, out.first[axis] + at);
      hn::StoreU(hn::DemoteTo(d8, last), d8, out.last[axis] + at);
    }
    // Of a lane without a box the last cell may come before the first.
    const M is_wide = hn::Ne(hn::ShiftRight<1>(hn::Or(more[1], more[2])), hn::Zero(d));
    const V row = hn::Add(hn::Mul(hn::Add(first[2], one), next_z), hn::Add(first[1], one));
    const V layer = hn::Mul(hn::Add(more[1], hn::Add(more[2], more[2])), rows);
    hn::StoreU(hn::IfThenZeroElse(is_wide, hn::Add(row, layer)), d, reinterpret_cast<std::int32_t*>(out.row) + at);
    out.wide |= std::uint64_t{bits_of_mask<std::int32_t>(is_wide)} << at;
  }
  mark_x(out.first[0], out.last[0], out.x);
}

/// One of the few, each bound in all lanes.
template <class Key>
struct One {
  Vec<Key> lo[3], hi[3];

  HWY_INLINE MaskOf<Key> apart(const BoxColumnsOf<Key>& many, std::size_t at) const {
    const Tag<Key> d;
    const auto on = [&](int axis) {
      return hn::Or(hn::Gt(hn::Load(d, many.lo[axis] + at), hi[axis]),
                    hn::Gt(lo[axis], hn::Load(d, many.hi[axis] + at)));
    };
    return hn::Or(hn::Or(on(0), on(1)), on(2));
  }
};

/// The mask of as many of the lanes of a vector of indices.
template <class Key>
HWY_INLINE MU hits_of(MaskOf<Key> apart) {
  const DU du;
  if constexpr (sizeof(Key) == 4) {
    return hn::Not(hn::RebindMask(du, apart));
  } else {
    const std::uint8_t bits[8] = {static_cast<std::uint8_t>(bits_of_mask<Key>(hn::Not(apart)))};
    return hn::LoadMaskBits(du, bits);
  }
}

template <class Key>
HWY_INLINE bool compare_all_few(const FewBoxes<Key>& few, const BoxColumnsOf<Key>& many, std::size_t end,
                                std::uint32_t first_id, bool few_first, PairBuffer& pairs) {
  const Tag<Key> d;
  const DU du;
  constexpr std::size_t step = lanes_of<Key>;
  for (std::uint64_t left = few.valid; left != 0; left &= left - 1) {
    const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
    One<Key> one;
    for (int axis = 0; axis < 3; ++axis) {
      one.lo[axis] = hn::Set(d, few.columns.lo[axis][i]);
      one.hi[axis] = hn::Set(d, few.columns.hi[axis][i]);
    }
    MaskOf<Key> apart[load_block / step];
    auto all_apart = apart[0] = one.apart(many, 0);
    for (std::size_t v = 1; v < end / step; ++v) {
      apart[v] = one.apart(many, v * step);
      all_apart = hn::And(all_apart, apart[v]);
    }
    if (HWY_LIKELY(hn::AllTrue(d, all_apart))) continue;
    const auto id = hn::Set(du, few.first_id + i);
    Pair* out = pairs.end();
    for (std::size_t v = 0; v < end / step; ++v) {
      const auto hit = hits_of<Key>(apart[v]);
      const std::size_t count = hn::CountTrue(du, hit);
      if (count == 0) continue;
      const auto found = hn::Compress(hn::Iota(du, first_id + static_cast<std::uint32_t>(v * step)), hit);
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

template <class Key>
HWY_INLINE bool compare_block(const FewBoxes<Key>& few, const BoxColumnsOf<Key>& many, std::size_t count,
                              std::uint32_t first_id, bool few_first, PairBuffer& pairs) {
  if (count == load_block)  // which most blocks are, so that the compiler knows the end
    return compare_all_few<Key>(few, many, load_block, first_id, few_first, pairs);
  return compare_all_few<Key>(few, many, (count + block - 1) / block * block, first_id, few_first, pairs);
}

HWY_ATTR bool CompareFew(const FewBoxes<std::int32_t>& few, const BoxColumns& many, std::size_t count,
                         std::uint32_t first_id, bool few_first, PairBuffer& pairs) {
  return compare_block<std::int32_t>(few, many, count, first_id, few_first, pairs);
}
HWY_ATTR bool CompareFew64(const FewBoxes<std::int64_t>& few, const BoxColumnsOf<std::int64_t>& many, std::size_t count,
                           std::uint32_t first_id, bool few_first, PairBuffer& pairs) {
  return compare_block<std::int64_t>(few, many, count, first_id, few_first, pairs);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(LoadColumns);
HWY_EXPORT(LoadColumns64);
HWY_EXPORT(LocateCells);
HWY_EXPORT(CompareFew);
HWY_EXPORT(CompareFew64);

namespace {

/// Boxes up to a multiple of lane_group, the last of which are none.
template <class S>
struct Padded {
  BasicAabb<S> boxes[load_block];
  std::size_t count;

  Padded(const BasicAabb<S>* from, std::size_t size) : count((size + lane_group - 1) / lane_group * lane_group) {
    constexpr S nan = std::numeric_limits<S>::quiet_NaN();
    std::fill(std::copy_n(from, size, boxes), boxes + count, BasicAabb<S>{{nan, nan, nan}, {nan, nan, nan}});
  }
};

}  // namespace

std::uint64_t load_columns(const Aabb* boxes, std::size_t count, BoxColumns& out) {
  if (count % lane_group == 0) return HWY_DYNAMIC_DISPATCH(LoadColumns)(boxes, count, out);
  const Padded<float> padded(boxes, count);
  return HWY_DYNAMIC_DISPATCH(LoadColumns)(padded.boxes, padded.count, out);
}

std::uint64_t load_columns(const Aabb64* boxes, std::size_t count, BoxColumnsOf<std::int64_t>& out) {
  if (count % lane_group == 0) return HWY_DYNAMIC_DISPATCH(LoadColumns64)(boxes, count, out);
  const Padded<double> padded(boxes, count);
  return HWY_DYNAMIC_DISPATCH(LoadColumns64)(padded.boxes, padded.count, out);
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

CellGrid::Axis::Axis(KeyKind kind, std::int32_t min_key, std::int32_t max_key, std::int32_t from_key,
                     std::int32_t to_key, unsigned cells)
    : min(min_key),
      max(max_key),
      are_floats(kind == KeyKind::float32),
      last_cell(static_cast<std::int32_t>(cells) - 1) {
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

bool compare_few(const FewBoxes<std::int32_t>& few, const BoxColumns& block, std::size_t count, std::uint32_t first_id,
                 bool few_first, PairBuffer& pairs) {
  return HWY_DYNAMIC_DISPATCH(CompareFew)(few, block, count, first_id, few_first, pairs);
}

bool compare_few(const FewBoxes<std::int64_t>& few, const BoxColumnsOf<std::int64_t>& block, std::size_t count,
                 std::uint32_t first_id, bool few_first, PairBuffer& pairs) {
  return HWY_DYNAMIC_DISPATCH(CompareFew64)(few, block, count, first_id, few_first, pairs);
}

}  // namespace boxstream::detail
#endif
