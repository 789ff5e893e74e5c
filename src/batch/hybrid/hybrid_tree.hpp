// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/function_ref.hpp>
#include <boxstream/span.hpp>
#include <boxstream/stats.hpp>

#include "base/arena.hpp"
#include "batch/leaf/sweep.hpp"
#include "batch/records/record.hpp"

namespace boxstream::detail {

/// Choices that the paper leaves open.
struct HybridRules {
  enum class Scans {
    /// Nodes of few records, and what is compared is in proportion to what overlaps: medians are exact, so no input
    /// misleads the tree. docs/internals/algorithm.md has the proof of its bound.
    bounded,
    /// Where one of the two sets of a node is smaller than the cutoff, as the paper has it.
    below_cutoff,
    /// Where a sample says that to compare costs less than to cut.
    sampled,
  };
  Scans scans = Scans::bounded;
  std::size_t cutoff = 0;
  /// By dimensions of the paper: [2] has the first level of the tree, [1] the second, and [0] is scanned.
  int axis[3] = {2, 1, 0};
};

/// Algorithm Hybrid of Zomorodian and Edelsbrunner, Fast software for box intersections, 2002 (section 4, figure 5): a
/// binary segment tree over one dimension, streamed as in section 3; where a box spans a node, the same one dimension
/// lower; and scans of small sets and of the last dimension. The paper streams two such trees, since each set is viewed
/// as intervals and as points. Here both are one, with the same medians: what is found in the first view is found in
/// the second as well, so that scans need not distinguish them.
///
/// At a node of an axis, *points* are the boxes that begin inside of its region, and *others* those that begin before
/// it; a pair that the region owns has a point. Others that reach beyond the last point overlap all points on this
/// axis: they are joined with them on the axes that are left. The rest is cut at a median of the points. Sets are
/// records in the arena, and are put into another order.
class HybridTree {
 public:
  HybridTree(SweepContext& sweep, Stats& stats, const HybridRules& rules = {})
      : sweep_(sweep), arena_(sweep.arena), stats_(stats), rules_(rules) {}

  struct Set {
    Record* records = nullptr;
    std::size_t points = 0;  // come first
    std::size_t others = 0;

    std::size_t size() const { return points + others; }
  };
  /// Of one set, or two.
  struct Node {
    Set set[2];
    int sets = 1;

    std::size_t points() const { return set[0].points + set[1].points; }
    std::size_t others() const { return set[0].others + set[1].others; }
    std::size_t size() const { return points() + others(); }
  };

  /// A part of a search that may be done by another thread.
  struct Task {
    Node node;
    int dimension;
    int levels_left;  // of cuts at medians that are not exact; not begun where there are more than any
    const Task* next;

    static constexpr int not_begun = 1 << 20;
  };

  /// Instead of searching, `join_self` and `join_cross` cut what has more than `most` records, and leave the rest to
  /// `do_task` of other trees, in the order in which one thread would do it. Nothing is freed before the caller's frame
  /// ends.
  void collect_tasks(std::size_t most) { most_of_task_ = most; }
  /// The first of them.
  const Task* tasks() const { return first_task_; }
  /// Leaves the task as it is, so that it may be done again.
  bool do_task(const Task& task);

  /// The pairs within `records`, or between `a` and `b`, that overlap and that the node owns. False when the buffer's
  /// owner wants to stop.
  bool join_self(Span<Record> records);
  bool join_cross(Span<Record> a, Span<Record> b);

 private:
  bool has_pairs(const Node& node) const;
  bool is_scanned(const Node& node) const;
  std::uint64_t tests_of_scan(const Node& node) const;
  bool sweep_self(Span<const Record> records, SweepPlan plan);
  bool sweep_cross(Span<const Record> a, Span<const Record> b, SweepPlan plan);
  bool scan(const Node& node);
  bool scan_last(const Node& node);
  bool begin_axis(Node node, int dimension);
  bool go_on(const Node& node, int dimension, int levels_left);
  bool is_collecting() const { return most_of_task_ != 0; }
  bool is_task(const Node& node) const { return is_collecting() && (node.size() <= most_of_task_ || is_scanned(node)); }
  bool hand_out(const Node& node, int dimension, int levels_left);
  bool cut(Node node, int dimension, int levels_left);
  bool join_spanning(Node& node, int dimension);
  std::uint64_t exact_median(const Node& node, int axis);
  Set take_right(Set& set, int axis, std::uint64_t median, std::uint32_t first_rank, std::int32_t right_begin);
  Set copy(const Record* records, std::size_t size);

  SweepContext& sweep_;
  Arena& arena_;
  Stats& stats_;
  HybridRules rules_;
  std::size_t most_of_task_ = 0;
  const Task* first_task_ = nullptr;
  Task* last_task_ = nullptr;
};

/// The bounded tree, for what others leave; on copies. `b` is empty for a single set.
bool join_bounded(Span<const Record> a, Span<const Record> b, bool is_self, SweepContext& sweep, Stats& stats);

/// The axes by how few boxes of a sample overlap there: the fewest are scanned, and the most have the second level of
/// the tree, which is hardly used.
void choose_axes(Span<const Record> a, Span<const Record> b, HybridRules& rules);

}  // namespace boxstream::detail
