// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/pair.hpp>

#include "pair_hash.hpp"
#include "search/plan.hpp"  // the engine's

namespace boxstream::bench {

/// As "plan:z,x32,y8": sweep along z, in 8 slabs along y of each of 32 slabs along x.
std::string name_of(const detail::FixedPlan& plan);

/// Every sweep axis, cut along no axis, one, or two, into each of so many slabs.
std::vector<detail::FixedPlan> all_plans(Span<const int> slab_counts);

/// While it lives, all searches of the program follow this plan.
class PlanInForce {
 public:
  explicit PlanInForce(const detail::FixedPlan& plan) { detail::fixed_plan = &plan; }
  ~PlanInForce() { detail::fixed_plan = nullptr; }
  PlanInForce(const PlanInForce&) = delete;
  PlanInForce& operator=(const PlanInForce&) = delete;
};

/// Tries plans made by hand on one batch.
class PlanSearch {
 public:
  struct Tried {
    detail::FixedPlan plan;
    double ms;  ///< of one run
  };

  PlanSearch(Detector& detector, Span<const Aabb> boxes, const PairSummary& expected)
      : detector_(detector), boxes_(boxes), expected_(expected) {}

  /// Runs each plan once, in an order that is as good as random, until so many seconds are over. Those that take much
  /// longer than `expected_ms`, or than the quickest so far, are stopped.
  void run(std::vector<detail::FixedPlan> plans, double expected_ms, double seconds, std::uint64_t seed);

  /// The quickest few, the quickest first.
  std::vector<Tried> quickest(std::size_t count) const;
  std::size_t tried() const { return tried_; }
  /// Whether all that were not stopped found the expected pairs.
  bool pairs_equal() const { return pairs_equal_; }

 private:
  void try_one(const detail::FixedPlan& plan, double expected_ms);

  Detector& detector_;
  Span<const Aabb> boxes_;
  PairSummary expected_;
  std::vector<Pair> pairs_;
  std::vector<Tried> kept_;
  double best_ms_ = 1e300;
  std::size_t tried_ = 0;
  bool pairs_equal_ = true;
};

}  // namespace boxstream::bench
