// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "papers/hybrid/hybrid_search.hpp"

namespace boxstream::papers {

/// The tree that a search has streamed, in the order in which its nodes were entered.
class TreeTrace {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  struct Entry {
    std::size_t parent;  ///< place of the node above; `none` at a root
    Node node;
    int dimension;
    std::size_t intervals, points;
    std::size_t spanning;  ///< |Im|; 0 where nothing was streamed
  };

  void enter(Node node, int d, std::size_t intervals, std::size_t points) {
    entries_.push_back({current_, node, d, intervals, points, 0});
    current_ = entries_.size() - 1;
  }
  void spanning(std::size_t count) { entries_[current_].spanning = count; }
  void leave() { current_ = entries_[current_].parent; }

  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
  std::size_t current_ = none;
};

/// A trace that outlives the search.
struct TraceReference {
  TreeTrace* trace;

  void enter(Node node, int d, std::size_t intervals, std::size_t points) { trace->enter(node, d, intervals, points); }
  void spanning(std::size_t count) { trace->spanning(count); }
  void leave() { trace->leave(); }
};

}  // namespace boxstream::papers
