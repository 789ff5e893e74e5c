// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>
#include <boxstream/stats.hpp>

#include "arena.hpp"
#include "pair_buffer.hpp"
#include "plan.hpp"
#include "record.hpp"
#include "sweep.hpp"

namespace boxstream::detail {

/// The streamed tree: a recursion over nodes that exist only while they are worked on. docs/algorithm.md has the
/// argument why each pair is found exactly once. All calls return false when the buffer's owner wants to stop.
class Tree {
 public:
  Tree(Arena& arena, PairBuffer& pairs, KeyKind kind, PairOrder order, Stats& stats)
      : arena_(arena), stats_(stats), sweep_{arena, pairs, kind, order} {}
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
  template <class Source>
  bool sweep(const Source& boxes, const SweepPlan& plan);
  template <class Source>
  bool sweep(const Source& a, const Source& b, const SweepPlan& plan);

  Arena& arena_;
  Stats& stats_;
  SweepContext sweep_;
};

}  // namespace boxstream::detail
