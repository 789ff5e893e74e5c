// SPDX-License-Identifier: MIT
#include "suites/plan_search.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "inputs/random.hpp"
#include "tables/measuring.hpp"

namespace boxstream::bench {

namespace {

/// One run may be disturbed, so a plan is only given up, or left out of the rounds, when it is this much slower than
/// the quickest.
constexpr double hopeless_factor = 1.6;

}  // namespace

std::string name_of(const detail::FixedPlan& plan) {
  std::string name = fmt::format("plan:{}", "xyz"[plan.sweep_axis]);
  for (int i = 0; i < plan.levels; ++i) name += fmt::format(",{}{}", "xyz"[plan.level[i].axis], plan.level[i].slabs);
  return name;
}

std::vector<detail::FixedPlan> all_plans(Span<const int> slab_counts) {
  std::vector<detail::FixedPlan> plans;
  for (int w = 0; w < 3; ++w) {
    plans.push_back({w, 0, {}});
    for (int u = 0; u < 3; ++u)
      for (const int slabs_u : slab_counts) {
        plans.push_back({w, 1, {{u, slabs_u}, {}}});
        for (int v = 0; v < 3; ++v)
          for (const int slabs_v : slab_counts)
            if (v != u) plans.push_back({w, 2, {{u, slabs_u}, {v, slabs_v}}});
      }
  }
  return plans;
}

Stats PlannedSearch::find_pairs(const detail::FixedPlan& plan, Span<const Aabb> boxes, std::vector<Pair>& out) {
  out.clear();
  return stream_pairs(plan, boxes, [&](Span<const Pair> pairs) {
    out.insert(out.end(), pairs.begin(), pairs.end());
    return true;
  });
}

void PlanSearch::run(std::vector<detail::FixedPlan> plans, double expected_ms, double seconds, std::uint64_t seed) {
  // So that a good one comes early, and the bad ones are stopped.
  batches::Random random(seed);
  for (std::size_t i = plans.size(); i > 1; --i)
    std::swap(plans[i - 1], plans[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(i) - 1))]);
  const Elapsed elapsed;
  for (const detail::FixedPlan& plan : plans) {
    if (elapsed.seconds() > seconds) break;
    try_one(plan, expected_ms);
  }
}

void PlanSearch::try_one(const detail::FixedPlan& plan, double expected_ms) {
  const Elapsed elapsed;
  const double patience_ms = 2 * hopeless_factor * std::min(best_ms_, expected_ms);
  bool stopped = false;
  pairs_.clear();
  const double ms = time_once([&] {
    search_.stream_pairs(plan, boxes_, [&](Span<const Pair> pairs) {
      pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
      stopped = elapsed.milliseconds() > patience_ms;
      return !stopped;
    });
  });
  ++tried_;
  if (stopped) return;
  pairs_equal_ = pairs_equal_ && summarize(pairs_) == expected_;
  best_ms_ = std::min(best_ms_, ms);
  if (ms <= hopeless_factor * best_ms_) kept_.push_back({plan, ms});
}

std::vector<PlanSearch::Tried> PlanSearch::quickest(std::size_t count) const {
  std::vector<Tried> quickest = kept_;
  std::sort(quickest.begin(), quickest.end(), [](const Tried& a, const Tried& b) { return a.ms < b.ms; });
  if (quickest.size() > count) quickest.resize(count);
  return quickest;
}

}  // namespace boxstream::bench
