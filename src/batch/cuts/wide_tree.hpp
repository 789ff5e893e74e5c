// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/span.hpp>
#include <boxstream/stats.hpp>

#include "base/arena.hpp"
#include "base/thresholds.hpp"
#include "batch/cuts/plan.hpp"
#include "batch/hybrid/hybrid_tree.hpp"
#include "batch/leaf/sweep.hpp"
#include "batch/parallel/team.hpp"
#include "batch/records/pair_buffer.hpp"
#include "batch/records/source.hpp"

namespace boxstream::detail {

/// The streamed tree: a recursion over nodes that exist only while they are worked on. docs/internals/algorithm.md has
/// the argument why each pair is found exactly once. All calls return false when the buffer's owner wants to stop.
class WideTree {
 public:
  /// For a search of this number of `boxes`, of both sets. With a `team`, large nodes are worked on by all of it. A
  /// plan `by_hand` takes the planner's place.
  WideTree(std::size_t boxes, const SweepContext& sweep, Stats& stats, Team* team = nullptr,
           const FixedPlan* by_hand = nullptr)
      : arena_(sweep.arena),
        stats_(stats),
        team_(team),
        by_hand_(by_hand),
        sweep_(sweep),
        tests_per_box_(cube(std::bit_width(boxes)) / thresholds.share_of_tests) {}
  ~WideTree() { stats_.tests += sweep_.tests; }
  WideTree(const WideTree&) = delete;
  WideTree& operator=(const WideTree&) = delete;

  static constexpr std::uint64_t one_copy = 256, all_copies = thresholds.most_copies * one_copy;

  /// What a node gets from its parent.
  struct Context {
    unsigned blocked = 0;  // axes that do not split this set any further
    int depth = 0;
    const Plan* parent = nullptr;       // null at the root
    std::uint64_t copies = all_copies;  // that the leaves below may hold of each box here, in 1/256
  };

  template <class Source>
  bool join_self(const Source& boxes, Context context);
  template <class Source>
  bool join_cross(const Source& a, const Source& b, Context context);

 private:
  /// The team, if it can help with a node of that many boxes.
  Team* team_for(std::size_t boxes) const {
    return team_ != nullptr && boxes >= team_->least_boxes() ? team_ : nullptr;
  }

  enum class Split { no_progress, stopped, done };

  /// Splits a node into no more than `most_copies` of a box, and does its children with `context`, in which it notes
  /// what is left to them of their parent's copies. Large boxes are left to the caller.
  template <class Parts>
  Split split(Parts& parts, Context& context, Team* team, std::size_t most_copies);

  /// Splits a node as planned, and does all that is below it.
  template <class Source>
  bool cut_self(const Source& boxes, Plan& plan, const Context& context);
  template <class Source>
  bool cut_cross(const Source& a, const Source& b, Plan& plan, const Context& context);

  template <class... Sources>
  bool sweep(SweepPlan plan, const Context& context, const Sources&... sources);

  static std::uint64_t cube(int x) { return std::uint64_t(x) * std::uint64_t(x) * std::uint64_t(x); }
  std::uint64_t most_tests(std::size_t boxes, const Context& context) const {
    return boxes * tests_per_box_ * context.copies / all_copies;
  }

  Arena& arena_;
  Stats& stats_;
  Team* team_;
  const FixedPlan* by_hand_;
  SweepContext sweep_;
  std::uint64_t tests_per_box_;  // that a sweep may make, if it is of the whole search
};

}  // namespace boxstream::detail
