// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "index/bvh.hpp"
#include "world/nearest_block.hpp"
#include "world/nearest_distance.hpp"

namespace boxstream::detail {

/// The box at a place of the index.
template <class S>
BasicAabb<S> box_at(const Bvh<S>& bvh, std::size_t place) {
  return bvh.block(0, place / BoxBlock<S>::width).get(place % BoxBlock<S>::width);
}

/// Boxes that are near, of two leaves at most: places in one index, or in two, and the distance.
template <class S>
struct NearOnes {
  struct One {
    S distance;
    std::uint32_t place;
    std::uint32_t other;
  };

  void add(const One& one) {
    unsigned at = size++;
    for (; at > 0 && one.distance < ones[at - 1].distance; --at) ones[at] = ones[at - 1];
    ones[at] = one;
  }
  const One* begin() const { return ones; }
  const One* end() const { return ones + size; }

  unsigned size = 0;
  One ones[BoxBlock<S>::width * BoxBlock<S>::width];  // by distance
};

/// Hands on what leaves have.
template <class S, class Offer>
class NearLeaves {
 public:
  NearLeaves(const NearLimit<S>& limit, Offer offer) : limit_(limit), offer_(offer) {}

  /// `resolve(bit)` is what a bit of the mask stands for; `squared[bit]` is about how far off. All bits together, for
  /// changing between floating-point environments takes longer than a distance; but the nearest one of the first leaf
  /// goes alone, because it mostly brings the limit down from infinity.
  template <class Mask, class Resolve>
  void visit(Mask mask, const S* squared, Resolve&& resolve) {
    if (is_first_ && mask != 0) {
      is_first_ = false;
      const unsigned nearest = nearest_of(mask, squared);
      visit(Mask{1} << nearest, squared, resolve);
      mask &= ~(Mask{1} << nearest);
    }
    const S reach = limit_.reach();
    NearOnes<S> near;
    for (; mask != 0; mask &= mask - 1) {
      const auto bit = static_cast<unsigned>(std::countr_zero(mask));
      if (squared[bit] > reach) continue;
      const auto one = resolve(bit);
      if (limit_.is_above(one.distance)) near.add(one);
    }
    if (near.size != 0) offer_(near);
  }

 private:
  template <class Mask>
  static unsigned nearest_of(Mask mask, const S* squared) {
    auto nearest = static_cast<unsigned>(std::countr_zero(mask));
    for (; mask != 0; mask &= mask - 1) {
      const auto bit = static_cast<unsigned>(std::countr_zero(mask));
      nearest = squared[bit] < squared[nearest] ? bit : nearest;
    }
    return nearest;
  }

  const NearLimit<S>& limit_;
  Offer offer_;
  bool is_first_ = true;
};

/// Calls `offer(NearOnes)` for boxes of an index whose distance to `box` is below the limit, by leaves: near ones first
/// as far as nodes can tell. `offer` may change the limit, which counts from then on.
template <class S, class Offer>
class NearWalk {
 public:
  NearWalk(const Bvh<S>& bvh, const NearLimit<S>& limit, Offer offer) : bvh_(bvh), limit_(limit), leaves_(limit, offer) {}

  void run(const BasicAabb<S>& box) {
    for (std::size_t b = bvh_.tree_blocks(); b < bvh_.leaf_blocks() && !limit_.is_over(); ++b) visit_leaf(box, b);
    walk_tree(box);
  }

  /// Without newcomers.
  void walk_tree(const BasicAabb<S>& box) {
    if (bvh_.levels() == 0) return;
    WalkStack<S, Bvh<S>::most_levels> stack;
    stack.push(0, 0, bvh_.levels() - 1);
    while (!stack.empty() && !limit_.is_over()) {
      const auto at = stack.pop();
      const S reach = limit_.reach();
      if (at.key > reach) continue;
      if (at.level == 0) {
        visit_leaf(box, at.block);
        continue;
      }
      S squared[width];
      const unsigned first = stack.size();
      for (auto mask = lanes_near(bvh_.block(at.level, at.block), box, reach, squared); mask != 0; mask &= mask - 1) {
        const auto lane = static_cast<unsigned>(std::countr_zero(mask));
        stack.push_sorted(first, squared[lane], at.block * std::size_t{width} + lane, at.level - 1);
      }
    }
  }

 private:
  static constexpr unsigned width = BoxBlock<S>::width;

  void visit_leaf(const BasicAabb<S>& box, std::size_t block) {
    S squared[width];
    const unsigned mask = lanes_near(bvh_.block(0, block), box, limit_.reach(), squared);
    leaves_.visit(mask, squared, [&](unsigned lane) -> typename NearOnes<S>::One {
      const std::size_t place = block * width + lane;
      return {distance_below(box, box_at(bvh_, place)), static_cast<std::uint32_t>(place), 0};
    });
  }

  const Bvh<S>& bvh_;
  const NearLimit<S>& limit_;
  NearLeaves<S, Offer> leaves_;
};

/// The same for pairs of boxes of two indexes, `place` in x and `other` in y, or of one, each once.
template <class S, class Offer>
class NearPairWalk {
 public:
  NearPairWalk(const Bvh<S>& x, const Bvh<S>& y, const NearLimit<S>& limit, Offer offer)
      : x_(x), y_(y), is_same_(&x == &y), limit_(limit), offer_(offer), leaves_(limit, offer) {}

  void run() {
    walk_trees();
    walk_newcomers<false>(x_, y_);
    if (!is_same_) walk_newcomers<true>(y_, x_);
    for (std::size_t a = x_.tree_blocks(); a < x_.leaf_blocks(); ++a)
      for (std::size_t b = is_same_ ? a : y_.tree_blocks(); b < y_.leaf_blocks(); ++b) compare_leaves(a, b);
  }

 private:
  static constexpr unsigned width = BoxBlock<S>::width;

  /// Two blocks yet to be compared, on levels of their own.
  struct Step {
    S squared;  // distance
    std::uint32_t a;
    std::uint32_t b;
    std::uint8_t level_a;
    std::uint8_t level_b;
  };

  /// The newcomers of one index with the tree of another.
  template <bool FromY>
  void walk_newcomers(const Bvh<S>& from, const Bvh<S>& tree) {
    for (std::size_t place = from.tree_blocks() * width; place < from.leaf_blocks() * width; ++place) {
      const BasicAabb<S> box = box_at(from, place);
      if (!is_valid(box)) continue;
      const auto offer = [&](NearOnes<S>& near) {
        for (unsigned i = 0; i < near.size; ++i) {
          near.ones[i].other = static_cast<std::uint32_t>(place);
          if (!FromY) std::swap(near.ones[i].place, near.ones[i].other);
        }
        offer_(near);
      };
      NearWalk<S, decltype(offer)>(tree, limit_, offer).walk_tree(box);
    }
  }

  void walk_trees() {
    if (x_.levels() == 0 || y_.levels() == 0) return;
    // Of a step, at most 64 are made one level lower, and it is gone.
    Step steps[width * width * Bvh<S>::most_levels];
    std::size_t size = 0;
    steps[size++] = {0, 0, 0, static_cast<std::uint8_t>(x_.levels() - 1), static_cast<std::uint8_t>(y_.levels() - 1)};
    while (size > 0 && !limit_.is_over()) {
      const Step at = steps[--size];
      if (at.squared > limit_.reach()) continue;
      if (at.level_a == 0 && at.level_b == 0)
        compare_leaves(at.a, at.b);
      else
        size = descend(at, steps + size) - steps;
    }
  }

  void compare_leaves(std::size_t a, std::size_t b) {
    if (limit_.is_over()) return;
    S squared[width * width];
    std::uint64_t mask = lanes_near(x_.block(0, a), y_.block(0, b), limit_.reach(), squared);
    if (is_same_ && a == b) mask &= above_diagonal;
    leaves_.visit(mask, squared, [&](unsigned bit) -> typename NearOnes<S>::One {
      const std::size_t place = a * width + bit / width, other = b * width + bit % width;
      return {distance_below(box_at(x_, place), box_at(y_, other)), static_cast<std::uint32_t>(place),
              static_cast<std::uint32_t>(other)};
    });
  }

  /// The higher block is replaced by its children, or both if they are on one level. The nearest ones come last.
  Step* descend(const Step& at, Step* const first) {
    const BoxBlock<S>& a = x_.block(at.level_a, at.a);
    const BoxBlock<S>& b = y_.block(at.level_b, at.b);
    Step* last = first;
    S squared[width * width];
    if (at.level_a > at.level_b) {
      for (auto mask = lanes_near(a, b.bounds(), limit_.reach(), squared); mask != 0; mask &= mask - 1) {
        const auto i = static_cast<unsigned>(std::countr_zero(mask));
        *last++ = {squared[i], child(at.a, i), at.b, lower(at.level_a), at.level_b};
      }
    } else if (at.level_a < at.level_b) {
      for (auto mask = lanes_near(b, a.bounds(), limit_.reach(), squared); mask != 0; mask &= mask - 1) {
        const auto j = static_cast<unsigned>(std::countr_zero(mask));
        *last++ = {squared[j], at.a, child(at.b, j), at.level_a, lower(at.level_b)};
      }
    } else {
      const bool is_self = is_same_ && at.a == at.b;
      std::uint64_t mask = lanes_near(a, b, limit_.reach(), squared);
      if (is_self) mask &= above_diagonal | diagonal;
      for (; mask != 0; mask &= mask - 1) {
        const auto bit = static_cast<unsigned>(std::countr_zero(mask)), i = bit / width, j = bit % width;
        // A block with itself comes before all others.
        const S key = is_self && i == j ? S(-1) : squared[bit];
        *last++ = {key, child(at.a, i), child(at.b, j), lower(at.level_a), lower(at.level_b)};
      }
    }
    std::sort(first, last, [](const Step& s, const Step& t) { return s.squared > t.squared; });
    return last;
  }

  static std::uint32_t child(std::uint32_t block, unsigned lane) { return block * width + lane; }
  static std::uint8_t lower(std::uint8_t level) { return static_cast<std::uint8_t>(level - 1); }

  static constexpr std::uint64_t diagonal = 0x8040201008040201;
  static constexpr std::uint64_t above_diagonal = [] {
    std::uint64_t mask = 0;
    for (unsigned i = 0; i < width; ++i)
      for (unsigned j = i + 1; j < width; ++j) mask |= std::uint64_t{1} << (width * i + j);
    return mask;
  }();

  const Bvh<S>& x_;
  const Bvh<S>& y_;
  const bool is_same_;
  const NearLimit<S>& limit_;
  Offer offer_;
  NearLeaves<S, Offer> leaves_;
};

}  // namespace boxstream::detail
