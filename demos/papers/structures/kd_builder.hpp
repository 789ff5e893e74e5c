// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <boxstream/span.hpp>

#include "papers/structures/kd_tree.hpp"

namespace boxstream::papers {

/// Builds a k-d tree as section 2.2 says, and a little at a time: sorts the points along every axis (bottom-up merge
/// sort), then splits these orders from the root down, each node in linear time. Nothing is left to chance, so the work
/// is bounded beforehand; a unit of work reads or moves one number.
///
/// The spans given must stay until `run` has finished.
template <int K>
class KdBuilder {
 public:
  using Tree = KdTree<K>;
  using Item = KdPoint<K>;

  /// Of the points of both spans.
  explicit KdBuilder(Span<const Item> a, Span<const Item> b = {}) : sources_{a, b}, size_(a.size() + b.size()) {
    items_.reserve(size_);
    arranged_.reserve(size_);
    scratch_.reserve(size_);
    side_.reserve(size_);
    for (auto& order : orders_) order.reserve(size_);
    if (size_ == 0) phase_ = Phase::finished;
  }

  /// No tree of n points takes more.
  static std::uint64_t work_of(std::size_t n) {
    std::uint64_t levels = 0;
    while ((std::size_t{1} << levels) < n) ++levels;
    return n * (2 + levels * static_cast<std::uint64_t>(K + 1 + 2 * (K - 1)));
  }

  /// Does at most `work` units; returns those done, fewer only if it has finished.
  std::uint64_t run(std::uint64_t work) {
    std::uint64_t done = 0;
    for (; done < work && phase_ != Phase::finished; ++done) step();
    return done;
  }

  bool finished() const { return phase_ == Phase::finished; }

  /// When it has finished, once.
  Tree take() { return Tree::of_arranged(std::move(arranged_)); }

 private:
  using Number = std::uint32_t;
  enum class Phase { gather, sort, mark, part, copy_back, arrange, finished };
  enum Side : std::uint8_t { low, median, high };
  struct Node {
    std::size_t first, last;
    std::size_t axis;
  };

  void step() {
    switch (phase_) {
      case Phase::gather:
        return gather();
      case Phase::sort:
        return sort();
      case Phase::mark:
        return mark();
      case Phase::part:
        return part();
      case Phase::copy_back:
        return copy_back();
      case Phase::arrange:
        return arrange();
      case Phase::finished:
        return;
    }
  }

  void gather() {
    const std::size_t i = items_.size();
    items_.push_back(i < sources_[0].size() ? sources_[0][i] : sources_[1][i - sources_[0].size()]);
    for (auto& order : orders_) order.push_back(static_cast<Number>(i));
    scratch_.push_back(0);
    side_.push_back(low);
    if (items_.size() < size_) return;
    if (size_ > 1) {
      phase_ = Phase::sort;
      begin_run(0);
    } else {
      begin_tree();
    }
  }

  /// Two runs of `width_` numbers, from `first` on, are merged into one.
  void begin_run(std::size_t first) {
    left_ = out_ = first;
    left_end_ = right_ = std::min(first + width_, size_);
    right_end_ = std::min(first + 2 * width_, size_);
  }

  void sort() {
    auto& order = orders_[axis_];
    const bool from_left = left_ < left_end_ &&
                           (right_ == right_end_ || items_[order[left_]].at[axis_] <= items_[order[right_]].at[axis_]);
    scratch_[out_++] = order[from_left ? left_++ : right_++];
    if (out_ < right_end_) return;
    if (out_ < size_) return begin_run(out_);
    std::swap(order, scratch_);
    width_ *= 2;
    if (width_ >= size_) {
      width_ = 1;
      if (++axis_ == K) return begin_tree();
    }
    begin_run(0);
  }

  void begin_tree() {
    nodes_.push_back({0, size_, 0});
    next_node();
  }

  void next_node() {
    while (!nodes_.empty()) {
      node_ = nodes_.back();
      nodes_.pop_back();
      if (node_.last - node_.first < Tree::leaf_size) continue;
      mid_ = Tree::middle(node_.first, node_.last);
      out_ = node_.first;
      phase_ = Phase::mark;
      return;
    }
    phase_ = Phase::arrange;
  }

  void mark() {
    side_[orders_[node_.axis][out_]] = out_ < mid_ ? low : out_ == mid_ ? median : high;
    if (++out_ < node_.last) return;
    other_ = 0;
    begin_parting();
  }

  /// The order along another axis, in two, each half still in order.
  void begin_parting() {
    if (other_ == node_.axis) ++other_;
    if (other_ == K) {
      const std::size_t axis = (node_.axis + 1) % K;
      nodes_.push_back({mid_ + 1, node_.last, axis});
      nodes_.push_back({node_.first, mid_, axis});
      return next_node();
    }
    out_ = left_ = node_.first;
    right_ = mid_ + 1;
    phase_ = Phase::part;
  }

  void part() {
    const Number number = orders_[other_][out_];
    const std::uint8_t side = side_[number];
    scratch_[side == low ? left_++ : side == median ? mid_ : right_++] = number;
    if (++out_ < node_.last) return;
    out_ = node_.first;
    phase_ = Phase::copy_back;
  }

  void copy_back() {
    orders_[other_][out_] = scratch_[out_];
    if (++out_ < node_.last) return;
    ++other_;
    begin_parting();
  }

  void arrange() {
    arranged_.push_back(items_[orders_[0][arranged_.size()]]);
    if (arranged_.size() == size_) phase_ = Phase::finished;
  }

  Span<const Item> sources_[2];
  std::size_t size_;
  Phase phase_ = Phase::gather;
  std::vector<Item> items_, arranged_;
  std::vector<Number> orders_[K], scratch_;
  std::vector<std::uint8_t> side_;
  // Sorting: the runs that are being merged.
  std::size_t axis_ = 0, width_ = 1, left_ = 0, left_end_ = 0, right_ = 0, right_end_ = 0, out_ = 0;
  // Splitting: the node, and the other axis whose order is being parted.
  std::vector<Node> nodes_;
  Node node_{};
  std::size_t mid_ = 0, other_ = 0;
};

}  // namespace boxstream::papers
