// SPDX-License-Identifier: MIT
//
// From the paper's program to Detector, step by step: what each step gains.
#include <fmt/core.h>

#include <bit>
#include <cstdint>
#include <stdexcept>

#include <boxstream/detector.hpp>

#include "inputs/batches.hpp"
#include "papers/hybrid/ranks.hpp"
#include "papers/hybrid/versions.hpp"
#include "suites/plan_search.hpp"
#include "suites/race.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

namespace {

/// Of these the best is shown: the paper has no rule for the cutoff.
constexpr std::uint32_t cutoffs[] = {30, 250, 1000, 2000, 8000};
constexpr int slab_counts[] = {8, 16, 32, 64};
constexpr std::size_t finalists = 3;

/// An integer that compares as the number does.
std::int32_t key_of(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x + 0.0f);  // of -0 that of +0
  return bits < 0 ? bits ^ INT32_MAX : bits;
}

/// Closed intervals of floats as half-open ones of integers.
std::vector<papers::Box> keys_of(Span<const Aabb> boxes) {
  std::vector<papers::Box> keys(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (int d = 0; d < 3; ++d) keys[i].projections[d] = {key_of(boxes[i].min[d]), key_of(boxes[i].max[d]) + 1};
  return keys;
}

void search_as_published(const std::vector<papers::Box>& boxes, std::uint32_t cutoff, std::vector<Pair>& pairs) {
  papers::HybridOptions options;
  options.cutoffs = papers::Cutoffs(cutoff);
  pairs.clear();
  papers::VersionTwo search(boxes);
  search.find_pairs(options, [&](std::uint32_t i, std::uint32_t j) { pairs.push_back({i, j}); });
}

Detector hybrid(std::uint32_t cutoff) {
  DetectorOptions options;
  options.method = Method::hybrid;
  options.cutoff = cutoff;
  return Detector(options);
}

std::vector<detail::FixedPlan> plans_of(int levels) {
  std::vector<detail::FixedPlan> plans = all_plans(slab_counts);
  std::erase_if(plans, [levels](const detail::FixedPlan& plan) { return plan.levels != levels; });
  return plans;
}

void climb(const std::string& name, std::size_t n, const Options& options, Report& report, Progress& progress) {
  progress.show(fmt::format("steps {} n={}", name, n));
  const std::vector<Aabb> boxes = batches::make(name, n, options.seed);
  Detector detector, sampled = hybrid(0);
  std::vector<Detector> scanning;
  for (const std::uint32_t cutoff : cutoffs) scanning.push_back(hybrid(cutoff));
  std::vector<Pair> pairs, others;
  const Stats planned = detector.find_pairs(boxes, pairs);
  const Stats paper = sampled.find_pairs(boxes, others);
  const PairSummary expected = summarize(pairs);
  const double ours_ms = time_once([&] { detector.find_pairs(boxes, pairs); });

  Race race(options, report, progress, Row{.suite = "steps", .case_name = name, .n = n, .k = expected.count});
  race.row.note = fmt::format("planned: {} nodes, {} leaves, {} over budget; by samples: {} nodes, {} scans",
                              planned.nodes, planned.cells, planned.over_budget, paper.nodes, paper.cells);
  const auto is_equal = [&] { return summarize(others) == expected; };
  for (std::size_t i = 0; i < std::size(cutoffs); ++i) {
    const std::uint32_t cutoff = cutoffs[i];
    const auto add = [&](const char* step, std::function<void()> run) {
      race.add(fmt::format("{}:{}", step, cutoff), std::move(run), is_equal, step);
    };
    add("published", [&, cutoff] { search_as_published(papers::ranks(boxes), cutoff, others); });
    add("keys", [&, cutoff] { search_as_published(keys_of(boxes), cutoff, others); });
    add("simd-scans", [&, i] { scanning[i].find_pairs(boxes, others); });
  }
  race.add(
      "samples", [&] { sampled.find_pairs(boxes, others); }, is_equal);
  PlannedSearch by_hand;
  std::vector<detail::FixedPlan> best;
  for (const int levels : {1, 2}) {
    PlanSearch search(boxes, expected);
    search.run(plans_of(levels), 4 * ours_ms, options.quick ? 1 : 4, options.seed);
    for (const PlanSearch::Tried& tried : search.quickest(finalists)) best.push_back(tried.plan);
  }
  for (const detail::FixedPlan& plan : best)
    race.add(
        name_of(plan), [&, plan] { by_hand.find_pairs(plan, boxes, others); }, is_equal,
        plan.levels == 1 ? "wide-nodes" : "two-axes");
  race.run([&] { detector.find_pairs(boxes, pairs); });
}

}  // namespace

void run_steps_suite(const Options& options, Report& report, Progress& progress) {
  const auto cases = options.cases_or({"U", "S"}, {"U", "S", "P", "R", "C", "W1", "M"});
  for (const std::size_t n : options.sizes_or({10000}, {100000}))
    for (const std::string& name : cases) climb(name, n, options, report, progress);
}

}  // namespace boxstream::bench
