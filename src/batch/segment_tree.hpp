// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <boxstream/span.hpp>
#include <boxstream/stats.hpp>

#include "base/arena.hpp"
#include "batch/record.hpp"
#include "batch/sweep.hpp"

namespace boxstream::detail {

/// The paper's streamed segment tree, for nodes that samples misjudge: it cuts at exact medians of the low ends, so no
/// input misleads it. docs/algorithm.md has the proof of its bound. Planned cuts are several times faster wherever they
/// work, so the Tree comes here only for what is over its budget.
///
/// At a node of an axis, *points* are the boxes that begin inside of its region, and *others* those that begin before
/// it; a pair that the region owns has a point. Others that reach beyond the last point overlap all points on this
/// axis: they are joined with them on the axes that are left. The rest is cut at the median of the points. Sets are
/// records in the arena, and are put into another order.
class SegmentTree {
 public:
  SegmentTree(SweepContext& sweep, Stats& stats) : sweep_(sweep), arena_(sweep.arena), stats_(stats) {}

  /// The pairs within `records`, or between `a` and `b`, that overlap and that the node owns. False when the buffer's
  /// owner wants to stop.
  bool join_self(Span<const Record> records);
  bool join_cross(Span<const Record> a, Span<const Record> b);

 private:
  struct Set {
    Record* records = nullptr;
    std::size_t points = 0;  // come first
    std::size_t others = 0;

    std::size_t size() const { return points + others; }
  };
  /// One set, or two.
  struct Node {
    Set set[2];
    int sets = 1;

    std::size_t points() const { return set[0].points + set[1].points; }
    std::size_t size() const { return set[0].size() + set[1].size(); }
  };
  struct Axes {
    int current;
    unsigned left;  // bit d: axis d is still to be decided, the current one among them
  };

  Set copy(const Record* records, std::size_t size);
  bool has_pairs(const Node& node) const;
  bool sweep_self(Span<const Record> records, const SweepPlan& plan);
  bool sweep_cross(Span<const Record> a, Span<const Record> b, const SweepPlan& plan);
  bool sweep_leaf(const Node& node, int axis);
  bool begin_axis(Node node, unsigned axes);
  bool sweep_last(const Node& node, int axis);
  bool cut(Node node, Axes axes);
  bool join_spanning(Node& node, Axes axes);
  std::uint64_t median(const Node& node, int axis);
  Set take_right(Set& set, int axis, std::uint64_t median, std::uint32_t first_rank, std::int32_t right_begin);

  SweepContext& sweep_;
  Arena& arena_;
  Stats& stats_;
};

}  // namespace boxstream::detail
