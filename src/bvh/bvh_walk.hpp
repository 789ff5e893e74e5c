// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cassert>
#include <iterator>

#include "base/keys.hpp"
#include "bvh/bvh.hpp"
#include "bvh/overlap_walk.hpp"

namespace boxstream::detail {

/// Blocks yet to be visited, nearest on top. A walk takes one block off and puts at most eight on, one level lower, so
/// seven a level suffice; it lives on the caller's stack and needs no heap.
template <class Key, unsigned Levels>
class WalkStack {
 public:
  struct Entry {
    Key key;  // where the walk enters the block
    std::uint32_t block;
    unsigned level;
  };

  bool empty() const { return size_ == 0; }
  Entry pop() {
    assert(size_ > 0);
    return entries_[--size_];
  }
  void push(Key key, std::size_t block, unsigned level) {
    assert(size_ < std::size(entries_));
    entries_[size_++] = {key, static_cast<std::uint32_t>(block), level};
  }

  /// Puts an entry below those of the same batch (`first` and up) that come before it.
  void push_sorted(unsigned first, Key key, std::size_t block, unsigned level) {
    assert(size_ < std::size(entries_));
    unsigned at = size_++;
    for (; at > first && entries_[at - 1].key < key; --at) entries_[at] = entries_[at - 1];
    entries_[at] = {key, static_cast<std::uint32_t>(block), level};
  }
  unsigned size() const { return size_; }

 private:
  Entry entries_[7 * Levels + 1];
  unsigned size_ = 0;
};

template <class S>
template <class Visit>
void Bvh<S>::for_each_overlap(const Box& box, Visit&& visit) const {
  assert(has_valid_keys(box));
  OverlapWalk walk(*this);
  while (find_next(*this, box, walk))
    for (unsigned lanes = walk.lanes; lanes != 0; lanes &= lanes - 1)
      if (!visit(slot_at_[walk.block * Block::width + static_cast<unsigned>(std::countr_zero(lanes))])) return;
}

template <class S>
template <class Visit>
void Bvh<S>::for_each_hit(const RaySlabs<S>& ray, Visit&& visit) const {
  if (ray.hits_nothing) return;
  S length = ray.length;
  S enter[Block::width];
  const auto visit_leaf = [&](std::size_t b) {
    for (auto mask = leaves_[b].hit(ray, length, enter); mask != 0; mask &= mask - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(mask));
      if (!(enter[lane] <= length)) continue;  // clipped since the block was tested
      const S clipped = visit(slot_at_[b * Block::width + lane], enter[lane], length);
      if (!(clipped >= 0)) return false;
      length = clipped < length ? clipped : length;
    }
    return true;
  };
  for (std::size_t b = tree_size_ / Block::width; b < leaves_.size(); ++b)
    if (!visit_leaf(b)) return;
  if (tree_size_ == 0) return;

  WalkStack<S, most_levels> stack;
  stack.push(0, 0, static_cast<unsigned>(levels_.size() - 1));
  while (!stack.empty()) {
    const auto at = stack.pop();
    if (!(at.key <= length)) continue;
    if (at.level == 0) {
      if (!visit_leaf(at.block)) return;
      continue;
    }
    const unsigned first = stack.size();
    for (auto mask = block(at.level, at.block).hit(ray, length, enter); mask != 0; mask &= mask - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(mask));
      stack.push_sorted(first, enter[lane], at.block * std::size_t{Block::width} + lane, at.level - 1);
    }
  }
}

}  // namespace boxstream::detail
