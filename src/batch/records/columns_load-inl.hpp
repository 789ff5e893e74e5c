// SPDX-License-Identifier: MIT
//
// Boxes read into columns of keys, and vectors of them.

#if defined(BOXSTREAM_COLUMNS_LOAD_INL_HPP_) == defined(HWY_TARGET_TOGGLE)  // once per SIMD target
#ifdef BOXSTREAM_COLUMNS_LOAD_INL_HPP_
#undef BOXSTREAM_COLUMNS_LOAD_INL_HPP_
#else
#define BOXSTREAM_COLUMNS_LOAD_INL_HPP_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/keys.hpp"
#include "batch/records/columns.hpp"
#include "batch/records/quadruples-inl.hpp"
#include "batch/records/sweep_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

/// Bounds of the boxes of half a block, or of as many of them as fit. Its size shows in the order of pairs.
constexpr std::size_t half_block = block / 2;
template <class Key>
using Narrow = hn::CappedTag<Key, half_block>;

#if HWY_TARGET == HWY_SCALAR

template <class DK>
HWY_INLINE void deinterleave_few(DK d, const Aabb* boxes, std::size_t, hn::VFromD<DK> (&bounds)[6]) {
  for (int i = 0; i < 6; ++i) bounds[i] = hn::LoadU(d, reinterpret_cast<const std::int32_t*>(boxes) + i);
}

#else

/// The bits of the bounds of as many boxes as there are lanes, in the order of an Aabb: lanes behind the last box
/// repeat it.
template <class DK>
HWY_INLINE void deinterleave_few(DK d, const Aabb* boxes, std::size_t last, hn::VFromD<DK> (&bounds)[6]) {
  const hn::RepartitionToWide<DK> d64;
  hn::VFromD<DK> first_four[4];
  load_columns_of(d, boxes, last, 0, first_four);
  for (int i = 0; i < 4; ++i) bounds[i] = first_four[i];
  const auto wide = [&](auto v) HWY_ATTR { return hn::BitCast(d64, v); };
  const auto row = [&](std::size_t i) HWY_ATTR { return load_every_fourth(d, boxes, i, last, 2); };
  const auto end01 = wide(hn::InterleaveUpper(d, row(0), row(1))), end23 = wide(hn::InterleaveUpper(d, row(2), row(3)));
  bounds[4] = hn::BitCast(d, hn::InterleaveLower(d64, end01, end23));
  bounds[5] = hn::BitCast(d, hn::InterleaveUpper(d64, end01, end23));
}

#endif

template <class DK>
HWY_INLINE void deinterleave_few(DK d, const Aabb64* boxes, std::size_t last, hn::VFromD<DK> (&bounds)[6]) {
  const auto box = hn::Min(hn::Iota(d, 0), hn::Set(d, static_cast<std::int64_t>(last)));
  const auto offset = hn::Add(hn::ShiftLeft<2>(box), hn::ShiftLeft<1>(box));
  for (int i = 0; i < 6; ++i) bounds[i] = hn::GatherIndex(d, reinterpret_cast<const std::int64_t*>(boxes) + i, offset);
}

/// order_key of each lane.
template <class DK>
HWY_INLINE hn::VFromD<DK> keys_of(DK d, hn::VFromD<DK> bits) {
  using Key = hn::TFromD<DK>;
  const auto keys = hn::Xor(bits, hn::And(hn::BroadcastSignBit(bits), hn::Set(d, std::numeric_limits<Key>::max())));
  return hn::Sub(keys, hn::VecFromMask(d, hn::Eq(keys, hn::Set(d, Key{-1}))));  // -0, and nothing else, has become -1
}

/// Keys of the first `count` lanes to columns, from `at` on. Others, and boxes that are not valid, will meet no box,
/// not even each other. Returns which are valid, lane i as bit i.
template <class DK, class Columns>
HWY_INLINE std::uint32_t store_keys(DK d, const hn::VFromD<DK> (&bits)[6], std::size_t count, std::size_t at,
                                    Faces faces, Columns& out) {
  using Key = hn::TFromD<DK>;
  const auto infinity = hn::Set(d, static_cast<Key>(infinity_key<Key>));
  hn::VFromD<DK> lo[3], hi[3];
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = keys_of(d, bits[axis]);
    hi[axis] = keys_of(d, bits[3 + axis]);
  }
  const auto lowest = hn::Min(hn::Min(lo[0], lo[1]), lo[2]), highest = hn::Max(hn::Max(hi[0], hi[1]), hi[2]);
  const auto beyond = hn::Or(hn::Gt(hn::Not(infinity), lowest), hn::Gt(highest, infinity));
  const auto inverted = hn::Or(hn::Or(hn::Gt(lo[0], hi[0]), hn::Gt(lo[1], hi[1])), hn::Gt(lo[2], hi[2]));
  auto wrong = hn::Or(beyond, inverted);
  for (auto& high : hi) high = hn::Sub(high, hn::Set(d, off_high<Key>(faces)));
  if (count < hn::MaxLanes(DK())) wrong = hn::Or(wrong, hn::Not(hn::FirstN(d, count)));
  const std::uint32_t wrong_lanes = bits_of(d, wrong);
  if (HWY_UNLIKELY(wrong_lanes != 0)) {
    lo[0] = hn::IfThenElse(wrong, hn::Set(d, std::numeric_limits<Key>::max()), lo[0]);
    hi[0] = hn::IfThenElse(wrong, hn::Set(d, std::numeric_limits<Key>::min()), hi[0]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    hn::Store(lo[axis], d, out.lo[axis] + at);
    hn::Store(hi[axis], d, out.hi[axis] + at);
  }
  return wrong_lanes ^ ((1u << hn::MaxLanes(d)) - 1);
}

/// `count` boxes, of which no more are read than there are lanes, to lanes from `at` on.
template <class S, class Key, std::size_t capacity>
HWY_INLINE std::uint32_t load_some(const BasicAabb<S>* boxes, std::size_t count, std::size_t at, Faces faces,
                                   BoxColumnsOf<Key, capacity>& out) {
  static_assert(sizeof(BasicAabb<S>) == 6 * sizeof(Key));
  const Narrow<Key> d;
  hn::VFromD<Narrow<Key>> bounds[6];
  deinterleave_few(d, boxes, count - 1, bounds);
  return store_keys(d, bounds, count, at, faces, out);
}

/// Boxes from `at` on, up to `count`. Returns which are valid.
template <class S, class Key>
HWY_INLINE std::uint64_t load_few(const BasicAabb<S>* boxes, std::size_t at, std::size_t count, Faces faces,
                                  BoxColumnsOf<Key>& out) {
  constexpr std::size_t step = hn::MaxLanes(Narrow<Key>());
  std::uint64_t valid = 0;
  for (; at + step <= count; at += step) valid |= std::uint64_t{load_some(boxes + at, step, at, faces, out)} << at;
  return at == count ? valid : valid | std::uint64_t{load_some(boxes + at, count - at, at, faces, out)} << at;
}

/// A box in each lane, or the same one in all.
template <class DK>
struct Bounds {
  using Mask = decltype(hn::Gt(hn::Zero(DK()), hn::Zero(DK())));

  hn::VFromD<DK> lo[3], hi[3];

  // One that the compiler makes would be outside the SIMD target.
  HWY_INLINE Bounds() {}
  template <class Columns>
  HWY_INLINE void load(const Columns& from, std::size_t at) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = hn::Load(DK(), from.lo[axis] + at);
      hi[axis] = hn::Load(DK(), from.hi[axis] + at);
    }
  }
  template <class Columns>
  HWY_INLINE void repeat(const Columns& from, std::size_t i) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = hn::Set(DK(), from.lo[axis][i]);
      hi[axis] = hn::Set(DK(), from.hi[axis][i]);
    }
  }
  HWY_INLINE Mask disjoint(const Bounds& other) const {
    const auto on = [&](int axis)
                        HWY_ATTR { return hn::Or(hn::Gt(lo[axis], other.hi[axis]), hn::Gt(other.lo[axis], hi[axis])); };
    return hn::Or(hn::Or(on(0), on(1)), on(2));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#endif
