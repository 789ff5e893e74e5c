// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "base/arena.hpp"
#include "base/even_parts.hpp"
#include "batch/cuts/cells.hpp"
#include "batch/leaf/sweep.hpp"
#include "batch/records/record.hpp"

namespace boxstream::detail {

/// What to do at a node: sweep it as it is, or split it into slabs along one axis.
struct Plan {
  static constexpr int most_slabs = int{Slabs::most};

  SweepPlan sweep;
  Grid grid;  ///< without an axis of rows: sweep
  /// For the children: whether they are meant to be swept at once, and of what size they should then be.
  bool children_are_leaves = false;
  double leaf_size = 0;
};

/// Up to `capacity` boxes of a node, bounds apart. Which ones depends on the node's contents and order only.
class Sample {
 public:
  static constexpr std::size_t capacity = 8 * Slabs::most;

  explicit Sample(Arena& arena);

  /// How many boxes to draw from a node of `boxes`: enough that the quantiles of the slabs are good to a fraction of a
  /// slab, few enough that planning stays a few per cent of the work.
  static std::size_t wanted(std::size_t boxes);

  /// Draws `count` of the source's valid boxes, evenly spread but for a jitter that regular input cannot follow.
  template <class Source>
  void draw(const Source& source, std::size_t count) {
    const std::size_t n = source.size();
    if (count > n) count = n;
    for (std::size_t i = 0; i < count && size_ < capacity; ++i) {
      const std::size_t first = begin_of_part(n, i, count), next = begin_of_part(n, i + 1, count);
      assert(first < next && next <= n);
      const std::size_t at = first + jitter(i) % (next - first);
      if (source.valid(at)) add(source[at]);
    }
  }

  std::size_t size() const { return size_; }
  const std::int32_t* lo(int axis) const { return lo_[axis]; }
  const std::int32_t* hi(int axis) const { return hi_[axis]; }

 private:
  static std::uint32_t jitter(std::size_t i) {
    const auto x = static_cast<std::uint32_t>(i) * 0x9E3779B9u;
    return (x ^ (x >> 15)) * 0x85EBCA6Bu >> 8;
  }

  void add(const Record& r) {
    assert(size_ < capacity);
    for (int d = 0; d < 3; ++d) {
      // A box that begins before the region must not lend its low end to a splitter: splitters lie inside.
      lo_[d][size_] = (r.before >> d & 1) != 0 ? INT32_MIN : r.lo[d];
      hi_[d][size_] = std::max(r.lo[d], r.hi[d]);  // a flat open box ends before it begins
    }
    ++size_;
  }

  std::size_t size_ = 0;
  std::int32_t* lo_[3];
  std::int32_t* hi_[3];
};

/// A plan made by hand, for measurements that look for the best plan: by depth, which axis to cut into how many slabs.
/// Nodes of large boxes are planned as ever.
struct FixedPlan {
  struct Level {
    int axis;
    int slabs;
  };
  int sweep_axis = 0;
  int levels = 0;
  Level level[2];
};

/// The work a node holds: how many boxes, and how many pairs of them an all-pairs search would compare.
struct Workload {
  double boxes;
  double candidate_pairs;
  double pairs = 0;  ///< that a sweep finds and looks at; of a plan's own estimate
};

/// Picks the cheapest way through a node by a cost model fed with the sample. Axes in `blocked` (bit d) are not split.
/// A function of its arguments alone, the same on every machine. A plan `by_hand`, if not null, takes its place.
Plan make_plan(const Sample& sample, Workload work, unsigned blocked, int depth, const KeyKind (&kinds)[3],
               const FixedPlan* by_hand, Arena& arena);

}  // namespace boxstream::detail
