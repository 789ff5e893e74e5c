// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "index/bvh.hpp"

namespace boxstream::detail {

/// Two things yet to be compared, of two indexes or of one: boxes (level 0, by place) or blocks of leaves (level 1) and
/// of nodes (above).
template <class S>
struct NearStep {
  S squared;  // distance, about
  std::uint32_t a;
  std::uint32_t b;
  std::uint8_t level_a;
  std::uint8_t level_b;

  bool are_boxes() const { return (level_a | level_b) == 0; }
};

/// Steps of a query, on the caller's stack: a heap, and on top of it a stack for those that are in no order. As what is
/// on the stack comes first, there is room for all steps down to the boxes.
template <class S>
class NearQueue {
 public:
  using Step = NearStep<S>;

  bool empty() const { return size_ == 0; }
  void clear() { size_ = heap_ = 0; }
  /// Whether the next step can be put in order, or taken by it.
  bool is_in_order() const { return size_ == heap_ && size_ < room; }

  void push_last(const Step& step) { steps_[size_++] = step; }
  /// By hand, because std::push_heap reads what has just been written, in wider pieces, and waits for it.
  void push_in_order(const Step& step) {
    unsigned at = size_++;
    for (unsigned above; at > 0 && ComesLater()(steps_[above = (at - 1) / 2], step); at = above)
      steps_[at] = steps_[above];
    steps_[at] = step;
    ++heap_;
  }

  Step pop_last() {
    --size_;
    heap_ = std::min(heap_, size_);
    return steps_[size_];
  }
  Step pop_nearest() {
    std::pop_heap(steps_, steps_ + size_, ComesLater());
    return pop_last();
  }

 private:
  static constexpr unsigned room = 256;
  // A step has at most 64 children, and goes itself.
  static constexpr unsigned most_on_stack = 64 * (Bvh<S>::most_levels + 1);

  /// Of those at one distance, what is nearest to boxes comes first.
  struct ComesLater {
    bool operator()(const Step& s, const Step& t) const {
      return s.squared != t.squared ? s.squared > t.squared : s.level_a + s.level_b > t.level_a + t.level_b;
    }
  };

  unsigned size_ = 0;
  unsigned heap_ = 0;  // so many are a heap
  Step steps_[room + most_on_stack];
};

}  // namespace boxstream::detail
