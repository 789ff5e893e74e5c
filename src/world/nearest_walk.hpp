// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "index/bvh.hpp"
#include "world/nearest_block.hpp"
#include "world/nearest_scratch.hpp"

namespace boxstream::detail {

/// The box at a place of the index.
template <class S>
BasicAabb<S> box_at(const Bvh<S>& bvh, std::size_t place) {
  return bvh.block(0, place / BoxBlock<S>::width).get(place % BoxBlock<S>::width);
}

/// The bounds of a block, as the block above has them.
template <class S>
BasicAabb<S> bounds_of(const Bvh<S>& bvh, unsigned level, std::size_t block) {
  constexpr unsigned width = BoxBlock<S>::width;
  if (level + 1 == bvh.levels()) return bvh.block(level, block).bounds();
  return bvh.block(level + 1, block / width).get(block % width);
}

/// Lanes of one block yet to be visited.
template <class S>
struct NearLanes {
  S squared[BoxBlock<S>::width];  // distance
  unsigned mask;
  unsigned level;
  std::uint32_t block;

  /// The nearest one, which is taken out. There must be one.
  unsigned take() {
    auto nearest = static_cast<unsigned>(std::countr_zero(mask));
    for (auto rest = mask & (mask - 1); rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(rest));
      nearest = squared[lane] < squared[nearest] ? lane : nearest;
    }
    mask &= ~(1u << nearest);
    return nearest;
  }
};

/// Calls `offer(place, squared distance)` for newcomers that may be within the window of `band` around `box`, until the
/// band is tied.
template <class S, class Band, class Offer>
void walk_near_newcomers(const Bvh<S>& bvh, const BasicAabb<S>& box, const Band& band, Offer&& offer) {
  S squared[BoxBlock<S>::width];
  for (std::size_t b = bvh.tree_blocks(); b < bvh.leaf_blocks() && !band.is_tied(); ++b)
    for (auto mask = leaf_lanes_near(bvh.block(0, b), box, band.window(), squared); mask != 0; mask &= mask - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(mask));
      if (squared[lane] <= band.window().reach) offer(b * BoxBlock<S>::width + lane, squared[lane]);
    }
}

/// The same for the boxes of the tree, near ones first as far as nodes can tell.
template <class S, class Band, class Offer>
void walk_near(const Bvh<S>& bvh, const BasicAabb<S>& box, const Band& band, Offer&& offer) {
  if (bvh.levels() == 0) return;
  NearLanes<S> stack[Bvh<S>::most_levels];
  unsigned depth = 0;
  const auto enter = [&](unsigned level, std::size_t block) {
    NearLanes<S>& lanes = stack[depth++];
    lanes.mask = level == 0 ? leaf_lanes_near(bvh.block(0, block), box, band.window(), lanes.squared)
                            : lanes_near(bvh.block(level, block), box, band.window(), lanes.squared);
    lanes.level = level;
    lanes.block = static_cast<std::uint32_t>(block);
  };
  enter(bvh.levels() - 1, 0);
  while (depth > 0 && !band.is_tied()) {
    NearLanes<S>& lanes = stack[depth - 1];
    if (lanes.mask == 0) {
      --depth;
      continue;
    }
    const unsigned lane = lanes.take();
    const std::size_t below = lanes.block * std::size_t{BoxBlock<S>::width} + lane;
    if (lanes.squared[lane] > band.window().reach)
      --depth;  // and so are the others
    else if (lanes.level == 0)
      offer(below, lanes.squared[lane]);
    else
      enter(lanes.level - 1, below);
  }
}

/// Pairs of boxes of two trees, or of one, that may be within the window of a band.
template <class S, class Band, class Offer>
class NearPairWalk {
 public:
  NearPairWalk(const Bvh<S>& x, const Bvh<S>& y, const Band& band, std::vector<NearStep<S>>& steps, Offer offer)
      : x_(x), y_(y), is_same_(&x == &y), band_(band), steps_(steps), offer_(offer) {}

  /// Calls `offer(place in x, place in y, squared distance)`; of one tree, each pair once.
  void run() {
    walk_trees();
    walk_newcomers(x_, y_, offer_);
    if (is_same_) {
      for (std::size_t a = x_.tree_blocks(); a < x_.leaf_blocks(); ++a)
        for (std::size_t b = a; b < x_.leaf_blocks() && !band_.is_tied(); ++b) compare_leaves(a, b);
      return;
    }
    walk_newcomers(y_, x_, [&](std::size_t y, std::size_t x, S squared) { offer_(x, y, squared); });
    for (std::size_t a = x_.tree_blocks(); a < x_.leaf_blocks(); ++a)
      for (std::size_t b = y_.tree_blocks(); b < y_.leaf_blocks() && !band_.is_tied(); ++b) compare_leaves(a, b);
  }

 private:
  static constexpr unsigned width = BoxBlock<S>::width;
  using Step = NearStep<S>;

  /// The newcomers of one index in the tree of another.
  template <class OfferPair>
  void walk_newcomers(const Bvh<S>& from, const Bvh<S>& tree, OfferPair&& offer_pair) {
    if (tree.levels() == 0) return;
    for (std::size_t b = from.tree_blocks(); b < from.leaf_blocks() && !band_.is_tied(); ++b)
      for (unsigned lane = 0; lane < width; ++lane) {
        const BasicAabb<S> box = from.block(0, b).get(lane);
        if (!is_valid(box)) continue;
        walk_near(tree, box, band_,
                  [&](std::size_t other, S squared) { offer_pair(b * width + lane, other, squared); });
      }
  }

  void walk_trees() {
    if (x_.levels() == 0 || y_.levels() == 0) return;
    steps_.clear();
    steps_.push_back({0, 0, 0, static_cast<std::uint8_t>(x_.levels() - 1), static_cast<std::uint8_t>(y_.levels() - 1)});
    while (!steps_.empty() && !band_.is_tied()) {
      const Step at = steps_.back();
      steps_.pop_back();
      if (at.squared > band_.window().reach) continue;
      if (at.level_a == 0 && at.level_b == 0)
        compare_tree_leaves(at.a, at.b);
      else
        descend(at);
    }
  }

  /// Leaves that are near each other often have few boxes near the other one, or none.
  void compare_tree_leaves(std::size_t a, std::size_t b) {
    constexpr int few = 3;
    if (is_same_ && a == b) return compare_leaves(a, b);
    S squared[width];
    auto near = lanes_near(x_.block(0, a), bounds_of(y_, 0, b), band_.window(), squared);
    if (std::popcount(near) > few) return compare_leaves(a, b);
    for (; near != 0; near &= near - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(near));
      auto mask = leaf_lanes_near(y_.block(0, b), x_.block(0, a).get(i), band_.window(), squared);
      for (; mask != 0; mask &= mask - 1) {
        const auto j = static_cast<unsigned>(std::countr_zero(mask));
        if (squared[j] <= band_.window().reach) offer_(a * width + i, b * width + j, squared[j]);
      }
    }
  }

  void compare_leaves(std::size_t a, std::size_t b) {
    const bool is_self = is_same_ && a == b;
    S squared[width * width];
    std::uint64_t mask = leaf_lanes_near(x_.block(0, a), y_.block(0, b), band_.window(), squared);
    if (is_self) mask &= above_diagonal;
    for (; mask != 0; mask &= mask - 1) {
      const auto bit = static_cast<unsigned>(std::countr_zero(mask));
      if (squared[bit] <= band_.window().reach) offer_(a * width + bit / width, b * width + bit % width, squared[bit]);
    }
  }

  /// The higher block is replaced by its children, or both if they are on one level. The nearest ones come next.
  void descend(const Step& at) {
    const auto first = static_cast<std::ptrdiff_t>(steps_.size());
    const BoxBlock<S>& a = x_.block(at.level_a, at.a);
    const BoxBlock<S>& b = y_.block(at.level_b, at.b);
    const bool is_self = is_same_ && at.level_a == at.level_b && at.a == at.b;
    S squared[width];
    if (at.level_a > at.level_b) {
      for (auto mask = lanes_near(a, bounds_of(y_, at.level_b, at.b), band_.window(), squared); mask != 0;
           mask &= mask - 1) {
        const auto i = static_cast<unsigned>(std::countr_zero(mask));
        steps_.push_back({squared[i], child(at.a, i), at.b, lower(at.level_a), at.level_b});
      }
    } else if (at.level_a < at.level_b) {
      for (auto mask = lanes_near(b, bounds_of(x_, at.level_a, at.a), band_.window(), squared); mask != 0;
           mask &= mask - 1) {
        const auto j = static_cast<unsigned>(std::countr_zero(mask));
        steps_.push_back({squared[j], at.a, child(at.b, j), at.level_a, lower(at.level_b)});
      }
    } else {
      auto near = lanes_near(a, bounds_of(y_, at.level_b, at.b), band_.window(), squared);
      for (; near != 0; near &= near - 1) {
        const auto i = static_cast<unsigned>(std::countr_zero(near));
        const BasicAabb<S> box = a.get(i);
        auto mask = lanes_near(b, box, band_.window(), squared);
        if (is_self) mask &= ~0u << i;
        for (; mask != 0; mask &= mask - 1) {
          const auto j = static_cast<unsigned>(std::countr_zero(mask));
          // A block with itself comes before all others.
          const S key = is_self && i == j ? S(-1) : squared[j];
          steps_.push_back({key, child(at.a, i), child(at.b, j), lower(at.level_a), lower(at.level_b)});
        }
      }
    }
    std::sort(steps_.begin() + first, steps_.end(), [](const Step& s, const Step& t) { return s.squared > t.squared; });
  }

  static std::uint32_t child(std::uint32_t block, unsigned lane) { return block * width + lane; }
  static std::uint8_t lower(std::uint8_t level) { return static_cast<std::uint8_t>(level - 1); }

  static constexpr std::uint64_t above_diagonal = [] {
    std::uint64_t mask = 0;
    for (unsigned i = 0; i < width; ++i)
      for (unsigned j = i + 1; j < width; ++j) mask |= std::uint64_t{1} << (width * i + j);
    return mask;
  }();

  const Bvh<S>& x_;
  const Bvh<S>& y_;
  const bool is_same_;
  const Band& band_;
  std::vector<Step>& steps_;
  Offer offer_;
};

}  // namespace boxstream::detail
