// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <boxstream/aabb.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/span.hpp>
#include <boxstream/stats.hpp>

#include "arena.hpp"
#include "pair_buffer.hpp"
#include "plan.hpp"
#include "source.hpp"
#include "sweep.hpp"

namespace boxstream::detail {

class Tree;

/// Runs the children of the root, perhaps at the same time, and sees to it that their pairs come out in their order.
class ChildRunner {
 public:
  virtual ~ChildRunner() = default;
  virtual bool run(std::size_t count, FunctionRef<bool(Tree&, std::size_t)> child) = 0;
};

/// The streamed tree: a recursion over nodes that exist only while they are worked on. docs/algorithm.md has the
/// argument why each pair is found exactly once. All calls return false when the buffer's owner wants to stop.
class Tree {
 public:
  /// With a `runner`, the children of the root are left to it.
  Tree(Arena& arena, PairBuffer& pairs, const KeyKind (&kinds)[3], PairOrder order, Stats& stats,
       ChildRunner* runner = nullptr)
      : arena_(arena), stats_(stats), runner_(runner), sweep_{arena, pairs, {kinds[0], kinds[1], kinds[2]}, order} {}
  ~Tree() { stats_.tests += sweep_.tests; }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  /// What a node knows when it is entered.
  struct Context {
    unsigned blocked = 0;  // axes that do not split this set any further
    int depth = 0;
    const Plan* parent = nullptr;  // null at the root
  };

  template <class Source>
  bool join_self(const Source& boxes, Context context);
  template <class Source>
  bool join_cross(const Source& a, const Source& b, Context context);

 private:
  bool run_children(std::size_t count, int depth, FunctionRef<bool(Tree&, std::size_t)> child);

  template <class Source>
  bool sweep(const Source& boxes, const SweepPlan& plan);
  template <class Source>
  bool sweep(const Source& a, const Source& b, const SweepPlan& plan);

  Arena& arena_;
  Stats& stats_;
  ChildRunner* runner_;
  SweepContext sweep_;
};

}  // namespace boxstream::detail
