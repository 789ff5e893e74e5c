// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/pair.hpp>

#include "batch/search_by_plan.hpp"  // the engine's
#include "peers/pair_hash.hpp"

namespace boxstream::bench {

/// As "plan:z,x32,y8": sweep along z, in 8 slabs along y of each of 32 slabs along x.
std::string name_of(const detail::FixedPlan& plan);

/// Every sweep axis, cut along no, one or two axes into each number of slabs.
std::vector<detail::FixedPlan> all_plans(Span<const int> slab_counts);

/// Searches that follow a plan, with the memory of the one before.
class PlannedSearch {
 public:
  Stats stream_pairs(const detail::FixedPlan& plan, Span<const Aabb> boxes, PairSink sink) {
    const Stats stats = detail::search_by_plan<float>(plan, {boxes, boxes, {}, {}, true}, arena_, sink);
    arena_.settle(arena_.peak());
    return stats;
  }
  Stats find_pairs(const detail::FixedPlan& plan, Span<const Aabb> boxes, std::vector<Pair>& out);

 private:
  detail::Arena arena_;
};

/// Tries given plans on one batch.
class PlanSearch {
 public:
  struct Tried {
    detail::FixedPlan plan;
    double ms;  ///< of one run
  };

  PlanSearch(Span<const Aabb> boxes, const PairSummary& expected) : boxes_(boxes), expected_(expected) {}

  /// Runs each plan once, in random order, for up to `seconds`. Those that take much longer than `expected_ms`, or than
  /// the quickest so far, are stopped.
  void run(std::vector<detail::FixedPlan> plans, double expected_ms, double seconds, std::uint64_t seed);

  /// The quickest few, the quickest first.
  std::vector<Tried> quickest(std::size_t count) const;
  std::size_t tried() const { return tried_; }
  /// Whether all that were not stopped found the expected pairs.
  bool pairs_equal() const { return pairs_equal_; }

 private:
  void try_one(const detail::FixedPlan& plan, double expected_ms);

  PlannedSearch search_;
  Span<const Aabb> boxes_;
  PairSummary expected_;
  std::vector<Pair> pairs_;
  std::vector<Tried> kept_;
  double best_ms_ = 1e300;
  std::size_t tried_ = 0;
  bool pairs_equal_ = true;
};

}  // namespace boxstream::bench
