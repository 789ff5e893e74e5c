// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include "index/bvh.hpp"
#include "world/nearest_block.hpp"
#include "world/nearest_distance.hpp"
#include "world/nearest_queue.hpp"

namespace boxstream::detail {

/// What is compared: a box, or those of an index.
template <class S>
class NearSide {
 public:
  explicit NearSide(const BasicAabb<S>& box) : box_(&box) {}
  explicit NearSide(const Bvh<S>& bvh) : bvh_(&bvh) {}

  /// A box is the only one at level 0. An index has its root, if any, and its newcomers.
  template <class Visit>
  void for_each_top(Visit&& visit) const {
    if (bvh_ == nullptr) return visit(0, 0);
    if (bvh_->levels() != 0) visit(bvh_->levels(), 0);
    for (std::size_t b = bvh_->tree_blocks(); b < bvh_->leaf_blocks(); ++b) visit(1, static_cast<std::uint32_t>(b));
  }

  BasicAabb<S> box(std::size_t place) const {
    if (bvh_ == nullptr) return *box_;
    return bvh_->block(0, place / BoxBlock<S>::width).get(place % BoxBlock<S>::width);
  }
  const BoxBlock<S>& block(unsigned level, std::uint32_t block) const { return bvh_->block(level - 1, block); }

  /// A leaf whose boxes have nothing in common.
  bool is_of_newcomers(unsigned level, std::uint32_t at) const { return level == 1 && at >= bvh_->tree_blocks(); }

  /// Of a box or a block. Of blocks of the tree, the ones above have them.
  BasicAabb<S> bounds(unsigned level, std::uint32_t at) const {
    if (level == 0) return box(at);
    if (level >= bvh_->levels() || is_of_newcomers(level, at)) return block(level, at).bounds();
    return block(level + 1, at / BoxBlock<S>::width).get(at % BoxBlock<S>::width);
  }

  bool operator==(const NearSide&) const = default;

 private:
  const Bvh<S>* bvh_ = nullptr;
  const BasicAabb<S>* box_ = nullptr;
};

/// Calls `offer(place in x, place in y, distance)` for pairs of boxes whose distance is below the limit, of one index
/// each pair once. `offer` may change the limit, which counts from then on.
///
/// Pairs come by about increasing distance as long as that brings the limit down. When it does not any more, or there
/// are more than a few hundred to be put in order, they come as they are found.
template <class S, class Offer>
class NearWalk {
 public:
  NearWalk(NearSide<S> x, NearSide<S> y, NearLimit<S>& limit, Offer offer)
      : x_(x), y_(y), is_same_(x == y), limit_(limit), offer_(offer) {}

  void run() {
    x_.for_each_top([&](unsigned level_a, std::uint32_t a) {
      y_.for_each_top([&](unsigned level_b, std::uint32_t b) {
        if (is_same_ && (level_a < level_b || (level_a == level_b && b < a))) return;
        put({0, a, b, static_cast<std::uint8_t>(level_a), static_cast<std::uint8_t>(level_b)});
        if (!goes_by_distance()) drain();
      });
    });
    drain();
  }

 private:
  using Step = NearStep<S>;
  static constexpr unsigned width = BoxBlock<S>::width;
  static constexpr unsigned most_idle = 8;

  bool goes_by_distance() const { return idle_ < most_idle && queue_.is_in_order(); }

  void put(const Step& step) {
    if (goes_by_distance())
      queue_.push_in_order(step);
    else
      queue_.push_last(step);
  }

  void drain() {
    while (!queue_.empty() && !limit_.is_over()) {
      const bool is_nearest = goes_by_distance();
      const Step step = is_nearest ? queue_.pop_nearest() : queue_.pop_last();
      if (step.squared > limit_.reach()) {
        if (is_nearest) queue_.clear();
      } else if (step.are_boxes())
        visit(step);
      else
        open(step);
    }
  }

  void visit(const Step& step) {
    const S distance = distance_below(x_.box(step.a), y_.box(step.b));
    if (!limit_.is_above(distance)) return;
    const auto before = limit_;
    offer_(step.a, step.b, distance);
    idle_ = limit_ < before ? 0 : idle_ + 1;
  }

  /// The higher one is replaced by its children, or both if they are on one level; and newcomers at once.
  void open(const Step& at) {
    S squared[width * width];
    const S reach = limit_.reach();
    const std::uint8_t below_a = lower(at.level_a), below_b = lower(at.level_b);
    const bool is_a_higher =
        at.level_a > at.level_b ? !y_.is_of_newcomers(at.level_b, at.b) : x_.is_of_newcomers(at.level_a, at.a);
    if (at.level_a != at.level_b && is_a_higher) {
      const auto mask = lanes_near(x_.block(at.level_a, at.a), y_.bounds(at.level_b, at.b), reach, squared);
      go_on(mask, squared, [&](unsigned i) -> Step { return {squared[i], child(at.a, i), at.b, below_a, at.level_b}; });
    } else if (at.level_a != at.level_b) {
      const auto mask = lanes_near(y_.block(at.level_b, at.b), x_.bounds(at.level_a, at.a), reach, squared);
      go_on(mask, squared, [&](unsigned j) -> Step { return {squared[j], at.a, child(at.b, j), at.level_a, below_b}; });
    } else {
      auto mask = lanes_near(x_.block(at.level_a, at.a), y_.block(at.level_b, at.b), y_.bounds(at.level_b, at.b), reach,
                             squared);
      if (is_same_ && at.a == at.b) mask &= at.level_a == 1 ? above_diagonal : above_diagonal | diagonal;
      go_on(mask, squared, [&](unsigned bit) -> Step {
        return {squared[bit], child(at.a, bit / width), child(at.b, bit % width), below_a, below_b};
      });
    }
  }

  template <class Mask, class StepOf>
  void go_on(Mask mask, const S* squared, StepOf&& step_of) {
    if (mask == 0) return;
    if (is_first_ && step_of(0).are_boxes()) {
      // Mostly it brings the limit down from infinity, so that hardly anything else need be put in order.
      is_first_ = false;
      const unsigned nearest = nearest_of(mask, squared);
      mask &= ~(Mask{1} << nearest);
      visit(step_of(nearest));
    }
    const S reach = limit_.reach();
    for (; mask != 0; mask &= mask - 1) {
      const auto bit = static_cast<unsigned>(std::countr_zero(mask));
      if (!(squared[bit] <= reach)) continue;
      const Step step = step_of(bit);
      if (step.are_boxes() && !goes_by_distance())
        visit(step);
      else
        put(step);
    }
  }

  template <class Mask>
  static unsigned nearest_of(Mask mask, const S* squared) {
    auto nearest = static_cast<unsigned>(std::countr_zero(mask));
    for (; mask != 0; mask &= mask - 1) {
      const auto bit = static_cast<unsigned>(std::countr_zero(mask));
      nearest = squared[bit] < squared[nearest] ? bit : nearest;
    }
    return nearest;
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

  const NearSide<S> x_;
  const NearSide<S> y_;
  const bool is_same_;
  NearLimit<S>& limit_;
  Offer offer_;
  bool is_first_ = true;
  unsigned idle_ = 0;  // offers since the limit fell
  NearQueue<S> queue_;
};

}  // namespace boxstream::detail
