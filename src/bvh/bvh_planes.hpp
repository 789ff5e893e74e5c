// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include "bvh/bvh.hpp"
#include "bvh/bvh_walk.hpp"

namespace boxstream::detail {

/// The planes that still cut what a block bounds: a bit for each of the first 64. All others count as cutting.
class CuttingPlanes {
 public:
  explicit CuttingPlanes(Span<const PlaneTest> planes) : planes_(planes) {}

  using Mask = std::uint64_t;
  static constexpr Mask all = ~Mask{0};

  template <class S>
  unsigned not_behind(const BoxBlock<S>& block, Mask cutting) const {
    unsigned lanes = block.filled();
    for (std::size_t i = 0; i < planes_.size() && lanes != 0; ++i)
      if (cuts(i, cutting)) lanes &= planes_[i].not_behind(block);
    return lanes;
  }

  /// Of the planes that cut the parent box, those that cut this box.
  template <class S>
  Mask cutting(const BasicAabb<S>& box, Mask above) const {
    for (std::size_t i = 0; i < planes_.size() && i < most; ++i)
      if (cuts(i, above) && planes_[i].has_before(box)) above &= ~(Mask{1} << i);
    return above;
  }

 private:
  static constexpr std::size_t most = 64;
  static bool cuts(std::size_t plane, Mask cutting) { return plane >= most || (cutting >> plane & 1) != 0; }

  Span<const PlaneTest> planes_;
};

template <class S>
template <class Visit>
void Bvh<S>::for_each_not_behind(Span<const PlaneTest> planes, Visit&& visit) const {
  const CuttingPlanes test(planes);
  const auto visit_leaf = [&](std::size_t b, CuttingPlanes::Mask cutting) {
    for (auto mask = test.not_behind(leaves_[b], cutting); mask != 0; mask &= mask - 1)
      if (!visit(slot_at_[b * Block::width + static_cast<unsigned>(std::countr_zero(mask))])) return false;
    return true;
  };
  for (std::size_t b = tree_size_ / Block::width; b < leaves_.size(); ++b)
    if (!visit_leaf(b, CuttingPlanes::all)) return;
  if (tree_size_ == 0) return;

  WalkStack<CuttingPlanes::Mask, most_levels> stack;
  stack.push(CuttingPlanes::all, 0, static_cast<unsigned>(levels_.size() - 1));
  while (!stack.empty()) {
    const auto at = stack.pop();
    if (at.level == 0) {
      if (!visit_leaf(at.block, at.key)) return;
      continue;
    }
    const Block& here = block(at.level, at.block);
    for (auto mask = test.not_behind(here, at.key); mask != 0; mask &= mask - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(mask));
      stack.push(test.cutting(here.get(lane), at.key), at.block * std::size_t{Block::width} + lane, at.level - 1);
    }
  }
}

}  // namespace boxstream::detail
