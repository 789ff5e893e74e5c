// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "bvh.hpp"
#include "world_nearest_block.hpp"
#include "world_nearest_scratch.hpp"

namespace boxstream::detail {

/// Calls `offer(place)` for the boxes of leaf blocks [first, last) that may be within `window()` of `box`, which may
/// change meanwhile, until `done()`.
template <class S, class Window, class Done, class Offer>
void walk_near_row(const Bvh<S>& bvh, std::size_t first, std::size_t last, const BasicAabb<S>& box, Window&& window,
                   Done&& done, Offer&& offer) {
  S squared[BoxBlock<S>::width];
  for (std::size_t b = first; b < last && !done(); ++b)
    for (auto mask = lanes_near(bvh.block(0, b), box, window(), squared); mask != 0; mask &= mask - 1)
      offer(b * BoxBlock<S>::width + static_cast<unsigned>(std::countr_zero(mask)));
}

/// The same for those in the tree, near ones first as far as nodes can tell.
template <class S, class Window, class Done, class Offer>
void walk_near(const Bvh<S>& bvh, const BasicAabb<S>& box, std::vector<NearStep<S>>& steps, Window&& window,
               Done&& done, Offer&& offer) {
  constexpr std::size_t width = BoxBlock<S>::width;
  if (bvh.levels() == 0) return;
  S squared[width];
  steps.clear();
  steps.push_back({0, 0, 0, static_cast<std::uint8_t>(bvh.levels() - 1), 0});
  while (!steps.empty() && !done()) {
    const NearStep<S> at = steps.back();
    steps.pop_back();
    if (at.squared > window().reach) continue;
    auto mask = lanes_near(bvh.block(at.level_a, at.a), box, window(), squared);
    if (at.level_a == 0) {
      for (; mask != 0; mask &= mask - 1) offer(at.a * width + static_cast<unsigned>(std::countr_zero(mask)));
      continue;
    }
    const auto first = static_cast<std::ptrdiff_t>(steps.size());
    for (; mask != 0; mask &= mask - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(mask));
      steps.push_back({squared[lane], static_cast<std::uint32_t>(at.a * width + lane), 0,
                       static_cast<std::uint8_t>(at.level_a - 1), 0});
    }
    std::sort(steps.begin() + first, steps.end(),
              [](const NearStep<S>& x, const NearStep<S>& y) { return x.squared > y.squared; });
  }
}

/// Pairs of boxes of two trees, or of one, that may be within the window of a band.
template <class S, class Offer>
class NearPairWalk {
 public:
  NearPairWalk(const Bvh<S>& x, const Bvh<S>& y, NearScratch<S>& scratch, Offer offer)
      : x_(x), y_(y), is_same_(&x == &y), band_(scratch.band), steps_(scratch.steps), offer_(offer) {}

  /// Calls `offer(place in x, place in y)`; of one tree, each pair once.
  void run() {
    walk_trees();
    const auto window = [this]() -> const NearWindow<S>& { return band_.window(); };
    const auto done = [this] { return band_.is_tied(); };
    const auto newcomers = [&](const Bvh<S>& bvh, auto&& visit) {
      for (std::size_t b = bvh.tree_blocks(); b < bvh.leaf_blocks() && !done(); ++b)
        for (unsigned lane = 0; lane < width; ++lane) {
          const BasicAabb<S> box = bvh.block(0, b).get(lane);
          if (is_valid(box)) visit(b * width + lane, box);
        }
    };
    newcomers(x_, [&](std::size_t place, const BasicAabb<S>& box) {
      walk_near(y_, box, steps_, window, done, [&](std::size_t other) { offer_(place, other); });
    });
    if (is_same_) {
      for (std::size_t a = x_.tree_blocks(); a < x_.leaf_blocks(); ++a)
        for (std::size_t b = a; b < x_.leaf_blocks() && !done(); ++b) compare_leaves(a, b);
      return;
    }
    newcomers(y_, [&](std::size_t place, const BasicAabb<S>& box) {
      walk_near(x_, box, steps_, window, done, [&](std::size_t other) { offer_(other, place); });
    });
    for (std::size_t a = x_.tree_blocks(); a < x_.leaf_blocks(); ++a)
      for (std::size_t b = y_.tree_blocks(); b < y_.leaf_blocks() && !done(); ++b) compare_leaves(a, b);
  }

 private:
  static constexpr unsigned width = BoxBlock<S>::width;
  using Step = NearStep<S>;

  void walk_trees() {
    if (x_.levels() == 0 || y_.levels() == 0) return;
    steps_.clear();
    steps_.push_back({0, 0, 0, static_cast<std::uint8_t>(x_.levels() - 1), static_cast<std::uint8_t>(y_.levels() - 1)});
    while (!steps_.empty() && !band_.is_tied()) {
      const Step at = steps_.back();
      steps_.pop_back();
      if (at.squared > band_.window().reach) continue;
      if (at.level_a == 0 && at.level_b == 0)
        compare_leaves(at.a, at.b);
      else
        descend(at);
    }
  }

  void compare_leaves(std::size_t a, std::size_t b) {
    const bool is_self = is_same_ && a == b;
    std::uint64_t mask = lanes_near(x_.block(0, a), y_.block(0, b), band_.window().reach);
    if (is_self) mask &= above_diagonal;
    for (; mask != 0; mask &= mask - 1) {
      const auto bit = static_cast<unsigned>(std::countr_zero(mask));
      offer_(a * width + bit / width, b * width + bit % width);
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
      for (auto mask = lanes_near(a, b.bounds(), band_.window(), squared); mask != 0; mask &= mask - 1) {
        const auto i = static_cast<unsigned>(std::countr_zero(mask));
        steps_.push_back({squared[i], child(at.a, i), at.b, lower(at.level_a), at.level_b});
      }
    } else if (at.level_a < at.level_b) {
      for (auto mask = lanes_near(b, a.bounds(), band_.window(), squared); mask != 0; mask &= mask - 1) {
        const auto j = static_cast<unsigned>(std::countr_zero(mask));
        steps_.push_back({squared[j], at.a, child(at.b, j), at.level_a, lower(at.level_b)});
      }
    } else {
      for (unsigned i = 0; i < width; ++i) {
        const BasicAabb<S> box = a.get(i);
        if (!is_valid(box)) continue;
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
  NearBand<S>& band_;
  std::vector<Step>& steps_;
  Offer offer_;
};

}  // namespace boxstream::detail
