// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>

#include <cstddef>
#include <vector>

#include "papers/hybrid/box.hpp"
#include "papers/hybrid/hybrid_search.hpp"
#include "papers/hybrid/problem.hpp"
#include "papers/hybrid/procedures.hpp"

/// The paper's four implementations of Hybrid. Each holds what sections 6 and 7 say and nothing else; `find_pairs`
/// allocates nothing. A pointer is four bytes, as it was on the paper's machines, and so a place in an array.
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

/// Complete case, option 1: the boxes stay where they are, and three arrays of pointers to them are parted and merged.
/// The boxes have no number but their place, and sorting moves them: pairs are places in `boxes()`.
class VersionOne {
 public:
  static constexpr std::size_t bytes_per_box = sizeof(Box) + 3 * sizeof(Pointer);

  /// What is brought in order at first: the boxes themselves, which is the paper's advice, or only the pointers, which
  /// is how the version began (figure 13).
  enum class Sorting { structures, pointers };

  explicit VersionOne(Span<const Box> boxes);
  /// The first half of `find_pairs`, to be timed alone.
  void sort(Sorting sorting);
  /// `sort` must have been called once; the order stays.
  void find_pairs_sorted(const HybridOptions& options, Found found);
  /// The same with another procedure in place of Hybrid, on the pointers as they are in order (figure 6).
  void run_sorted(Procedure procedure, const HybridOptions& options, Found found);
  void find_pairs(Sorting sorting, const HybridOptions& options, Found found);

  const std::vector<Box>& boxes() const { return boxes_; }

 private:
  std::vector<Box> boxes_;
  std::vector<Pointer> intervals_, points_, temporary_;
};

/// Complete case, option 2: no pointers; the boxes are there twice, as intervals and as points, and are moved.
class VersionTwo {
 public:
  static constexpr std::size_t bytes_per_box = 2 * sizeof(NumberedBox);

  explicit VersionTwo(Span<const Box> boxes);
  void find_pairs(const HybridOptions& options, Found found);

 private:
  std::vector<NumberedBox> intervals_, points_;
};

/// Bipartite case: Version Two, where the two sets are there once anyway.
class VersionThree {
 public:
  static constexpr std::size_t bytes_per_box = sizeof(NumberedBox);

  VersionThree(Span<const Box> a, Span<const Box> b);
  void find_pairs(const HybridOptions& options, Found found);
  /// The same with a trace of the two trees, one after the other.
  void find_pairs(const HybridOptions& options, Found found, TreeTrace& trace);

 private:
  std::vector<NumberedBox> a_, b_;
};

/// Bipartite case for cubes: Version Three with one side in place of three.
class VersionFour {
 public:
  static constexpr std::size_t bytes_per_box = sizeof(Cube);

  /// `num` is set here.
  VersionFour(Span<const Cube> a, Span<const Cube> b);
  void find_pairs(const HybridOptions& options, Found found);

 private:
  std::vector<Cube> a_, b_;
};

/// The smallest cube with the low corner of `box` that covers it ("Bounding cubes", section 7; where in the cube the
/// box lies is left open there). The cube's ends must be ints.
Cube bounding_cube(const Box& box);
std::vector<Cube> bounding_cubes(Span<const Box> boxes);
std::vector<Box> as_boxes(Span<const Cube> cubes);

}  // namespace boxstream::papers
