// SPDX-License-Identifier: MIT
#include "bvh/overlap_walk.hpp"

#include <bit>

#include "bvh/bvh.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/overlap_walk.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "bvh/overlapping-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

/// The tree depth first: of each block on the way the lanes that are left.
template <class S>
HWY_ATTR HWY_INLINE bool go_on(const Bvh<S>& bvh, const BasicAabb<S>& of, OverlapWalk& at) {
  const BasicAabb<S> box = of;
  while (at.pending < bvh.leaf_blocks()) {
    at.block = static_cast<std::uint32_t>(at.pending++);
    at.lanes = overlapping(bvh.block(0, at.block), box);
    if (at.lanes != 0) return true;
  }
  if (at.has_tree) {
    at.has_tree = false;
    const unsigned root = bvh.levels() - 1;
    at.block = 0;
    at.lanes = overlapping(bvh.block(root, 0), box);
    if (root == 0) return at.lanes != 0;
    at.open[at.open_count++] = {0, static_cast<std::uint16_t>(root), static_cast<std::uint16_t>(at.lanes)};
  }
  while (at.open_count != 0) {
    OverlapWalk::Open& above = at.open[at.open_count - 1];
    const unsigned left = above.lanes;
    if (left == 0) {
      --at.open_count;
      continue;
    }
    above.lanes = static_cast<std::uint16_t>(left & (left - 1));
    const auto child = above.block * BoxBlock<S>::width + static_cast<unsigned>(std::countr_zero(left));
    const unsigned level = above.level - 1u;
    const unsigned lanes = overlapping(bvh.block(level, child), box);
    if (level == 0) {
      at.block = child;
      at.lanes = lanes;
      if (lanes != 0) return true;
    } else if (lanes != 0) {
      at.open[at.open_count++] = {child, static_cast<std::uint16_t>(level), static_cast<std::uint16_t>(lanes)};
    }
  }
  return false;
}

/// Each box against the blocks from its own on.
template <class S>
HWY_ATTR HWY_INLINE void find_rows(const BoxBlock<S>* blocks, std::size_t count, FewPairs& pairs) {
  constexpr std::size_t width = BoxBlock<S>::width;
  for (std::size_t i = 0; i < count * width; ++i) {
    std::uint64_t* const row = pairs.rows[i];
    for (std::size_t w = 0; w < FewPairs::most / 64; ++w) row[w] = 0;
    const BoxBlock<S>& own = blocks[i / width];
    if (!own.has_box(static_cast<unsigned>(i % width))) continue;
    const BasicAabb<S> box = own.get(static_cast<unsigned>(i % width));
    for (std::size_t j = i / width; j < count; ++j)
      row[j * width / 64] |= std::uint64_t{overlapping(blocks[j], box)} << j * width % 64;
    row[i / 64] &= ~std::uint64_t{1} << i % 64;
  }
}

HWY_ATTR void Rows32(const BoxBlock<float>* blocks, std::size_t count, FewPairs& pairs) {
  find_rows(blocks, count, pairs);
}
HWY_ATTR void Rows64(const BoxBlock<double>* blocks, std::size_t count, FewPairs& pairs) {
  find_rows(blocks, count, pairs);
}
HWY_ATTR bool Next32(const Bvh<float>& bvh, const Aabb& box, OverlapWalk& walk) {
  return go_on(bvh, box, walk);
}
HWY_ATTR bool Next64(const Bvh<double>& bvh, const Aabb64& box, OverlapWalk& walk) {
  return go_on(bvh, box, walk);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(Next32);
HWY_EXPORT(Next64);
HWY_EXPORT(Rows32);
HWY_EXPORT(Rows64);

void find_few_pairs(const BoxBlock<float>* blocks, std::size_t count, FewPairs& pairs) {
  HWY_DYNAMIC_DISPATCH(Rows32)(blocks, count, pairs);
}
void find_few_pairs(const BoxBlock<double>* blocks, std::size_t count, FewPairs& pairs) {
  HWY_DYNAMIC_DISPATCH(Rows64)(blocks, count, pairs);
}

bool find_next(const Bvh<float>& bvh, const Aabb& box, OverlapWalk& walk) {
  return HWY_DYNAMIC_DISPATCH(Next32)(bvh, box, walk);
}
bool find_next(const Bvh<double>& bvh, const Aabb64& box, OverlapWalk& walk) {
  return HWY_DYNAMIC_DISPATCH(Next64)(bvh, box, walk);
}

}  // namespace boxstream::detail
#endif
