// SPDX-License-Identifier: MIT
#include "nearest/box_walk.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nearest/box_walk.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "nearest/nearest_block-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

template <class S>
using Keys = typename NearLanes<S>::Key;

/// The least of the keys.
template <class S>
HWY_ATTR HWY_INLINE Keys<S> least_key(const Keys<S>* HWY_RESTRICT keys) {
  constexpr std::size_t width = NearLanes<S>::width;
  const hn::CappedTag<Keys<S>, width> d;
  auto least = hn::Load(d, keys);
  for (std::size_t i = hn::Lanes(d); i < width; i += hn::Lanes(d)) least = hn::Min(least, hn::Load(d, keys + i));
  return hn::GetLane(hn::MinOfLanes(d, least));
}

/// Sets the keys and returns the least of them.
template <class S>
HWY_ATTR HWY_INLINE Keys<S> set_keys(const BoxBlock<S>& HWY_RESTRICT block, const BasicAabb<S>& box,
                                     Keys<S>* HWY_RESTRICT keys) {
  constexpr std::size_t width = NearLanes<S>::width;
  const hn::CappedTag<S, width> d;
  const hn::RebindToSigned<decltype(d)> dk;
  const auto gone = hn::Set(dk, NearLanes<S>::gone);
  auto least = gone;
  for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
    const auto bits = hn::BitCast(dk, squared_distances(d, block, i, box.min, box.max));
    const auto with_lane =
        hn::Or(hn::AndNot(hn::Set(dk, NearLanes<S>::lane_bits), bits), hn::Iota(dk, static_cast<Keys<S>>(i)));
    const auto key = hn::IfThenElse(hn::RebindMask(dk, filled_lanes(d, block, i)), with_lane, gone);
    hn::Store(key, dk, keys + i);
    least = hn::Min(least, key);
  }
  return hn::GetLane(hn::MinOfLanes(dk, least));
}

template <class S>
HWY_ATTR HWY_INLINE void begin(const Bvh<S>& bvh, const BasicAabb<S>& box, BoxWalk<S>& walk) {
  NearLanes<S>& root = walk.open[0];
  root.block = 0;
  root.level = bvh.levels() - 1;
  set_keys(bvh.block(root.level, 0), box, root.keys);
  walk.count = 1;
}

template <class S>
HWY_ATTR HWY_INLINE bool go_on(const Bvh<S>& bvh, const BasicAabb<S>& of, Keys<S> reach, BoxWalk<S>& walk) {
  const BasicAabb<S> box = of;
  if (walk.count == 0) return false;
  Keys<S> least = least_key<S>(walk.leaf().keys);
  for (;;) {
    NearLanes<S>& at = walk.leaf();
    if (least > reach) {
      if (--walk.count == 0) return false;
      least = least_key<S>(walk.leaf().keys);
      continue;
    }
    if (at.level == 0) return true;
    const unsigned lane = NearLanes<S>::lane_of(least);
    at.keys[lane] = NearLanes<S>::gone;
    NearLanes<S>& below = walk.open[walk.count++];
    below.block = at.block * NearLanes<S>::width + lane;
    below.level = at.level - 1;
    least = set_keys(bvh.block(below.level, below.block), box, below.keys);
  }
}

template <class S>
HWY_ATTR HWY_INLINE void open(const BoxBlock<S>* leaves, std::size_t first, std::size_t count, const BasicAabb<S>& of,
                              BoxRow<S>& row) {
  const BasicAabb<S> box = of;
  for (std::size_t i = 0; i < NearLanes<S>::width; ++i) {
    row.nearest.keys[i] = NearLanes<S>::gone;
    if (i >= count) continue;
    NearLanes<S>& at = row.blocks[i];
    at.block = static_cast<std::uint32_t>(first + i);
    at.level = 0;
    const Keys<S> least = set_keys(leaves[first + i], box, at.keys);
    if (least != NearLanes<S>::gone) row.nearest.keys[i] = (least & ~NearLanes<S>::lane_bits) | static_cast<Keys<S>>(i);
  }
}

HWY_ATTR void Begin32(const Bvh<float>& bvh, const Aabb& box, BoxWalk<float>& walk) {
  begin(bvh, box, walk);
}
HWY_ATTR void Begin64(const Bvh<double>& bvh, const Aabb64& box, BoxWalk<double>& walk) {
  begin(bvh, box, walk);
}
HWY_ATTR bool NextLeaf32(const Bvh<float>& bvh, const Aabb& box, std::int32_t reach, BoxWalk<float>& walk) {
  return go_on(bvh, box, reach, walk);
}
HWY_ATTR bool NextLeaf64(const Bvh<double>& bvh, const Aabb64& box, std::int64_t reach, BoxWalk<double>& walk) {
  return go_on(bvh, box, reach, walk);
}
HWY_ATTR void Row32(const BoxBlock<float>* leaves, std::size_t first, std::size_t count, const Aabb& box,
                    BoxRow<float>& row) {
  open(leaves, first, count, box, row);
}
HWY_ATTR void Row64(const BoxBlock<double>* leaves, std::size_t first, std::size_t count, const Aabb64& box,
                    BoxRow<double>& row) {
  open(leaves, first, count, box, row);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(Begin32);
HWY_EXPORT(Begin64);
HWY_EXPORT(NextLeaf32);
HWY_EXPORT(NextLeaf64);
HWY_EXPORT(Row32);
HWY_EXPORT(Row64);

void begin_walk(const Bvh<float>& bvh, const Aabb& box, BoxWalk<float>& walk) {
  HWY_DYNAMIC_DISPATCH(Begin32)(bvh, box, walk);
}
void begin_walk(const Bvh<double>& bvh, const Aabb64& box, BoxWalk<double>& walk) {
  HWY_DYNAMIC_DISPATCH(Begin64)(bvh, box, walk);
}

bool find_next(const Bvh<float>& bvh, const Aabb& box, std::int32_t reach, BoxWalk<float>& walk) {
  return HWY_DYNAMIC_DISPATCH(NextLeaf32)(bvh, box, reach, walk);
}
bool find_next(const Bvh<double>& bvh, const Aabb64& box, std::int64_t reach, BoxWalk<double>& walk) {
  return HWY_DYNAMIC_DISPATCH(NextLeaf64)(bvh, box, reach, walk);
}

void open_row(const BoxBlock<float>* leaves, std::size_t first, std::size_t count, const Aabb& box,
              BoxRow<float>& row) {
  HWY_DYNAMIC_DISPATCH(Row32)(leaves, first, count, box, row);
}
void open_row(const BoxBlock<double>* leaves, std::size_t first, std::size_t count, const Aabb64& box,
              BoxRow<double>& row) {
  HWY_DYNAMIC_DISPATCH(Row64)(leaves, first, count, box, row);
}

}  // namespace boxstream::detail
#endif
