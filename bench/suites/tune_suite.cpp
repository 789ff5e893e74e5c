// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include <boxstream/detector.hpp>

#include "inputs/batches.hpp"
#include "suites/plan_search.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

namespace {

constexpr int slab_counts[] = {4, 8, 12, 16, 24, 32, 48, 64};
constexpr int few_slab_counts[] = {8, 24, 64};
constexpr std::size_t finalists = 6;

void compare_with_plans(const std::string& name, std::size_t n, const Options& options, Report& report,
                        Progress& progress) {
  progress.show(fmt::format("tune {} n={}", name, n));
  const std::vector<Aabb> boxes = batches::make(name, n, options.seed);
  Detector detector;
  std::vector<Pair> pairs;
  detector.find_pairs(boxes, pairs);
  const double ours_ms = time_once([&] { detector.find_pairs(boxes, pairs); });
  const PairSummary expected = summarize(pairs);

  const std::vector<detail::FixedPlan> plans = options.quick ? all_plans(few_slab_counts) : all_plans(slab_counts);
  PlanSearch search(boxes, expected);
  PlannedSearch planned;
  search.run(plans, ours_ms, options.quick ? 2 : 20, options.seed);

  const std::vector<PlanSearch::Tried> best = search.quickest(finalists);
  std::vector<Contestant> contestants{{[&] { detector.find_pairs(boxes, pairs); }}};
  for (const PlanSearch::Tried& tried : best)
    contestants.push_back({[&, &plan = tried.plan] { planned.find_pairs(plan, boxes, pairs); }});
  // Plans differ by a few per cent, so they take more rounds than peers do.
  Interleaving interleaving = options.interleaving;
  interleaving.repeats *= 3;
  const std::vector<Series> series = measure_interleaved(contestants, interleaving, [&](int round) {
    progress.show(fmt::format("tune {} n={}: round {} of {}", name, n, round + 1, interleaving.repeats));
  });
  progress.clear();

  Row row{.suite = "tune",
          .case_name = name,
          .n = n,
          .peer = "plan",
          .k = expected.count,
          .pairs_equal = search.pairs_equal(),
          .yardstick = true};
  row.set_ours(series[0]);
  row.note = fmt::format("{} of {} plans tried", search.tried(), plans.size());
  if (best.empty()) {
    row.skipped = "every plan takes more than three times as long";
  } else {
    const auto winner = std::min_element(series.begin() + 1, series.end(),
                                         [](const Series& a, const Series& b) { return a.median < b.median; });
    row.peer = name_of(best[static_cast<std::size_t>(winner - series.begin()) - 1].plan);
    row.set_peer(*winner);
  }
  report.add(std::move(row));
}

}  // namespace

void run_tune_suite(const Options& options, Report& report, Progress& progress) {
  if (!options.peers.empty()) throw std::invalid_argument("suite tune has plans for peers, and takes no --peer");
  const auto cases =
      options.cases_or({"U", "S", "P"}, {"U", "D", "S", "M", "M2", "P", "C", "W1", "W2", "W3", "R", "X"});
  for (const std::size_t n : options.sizes_or({100000}, {100000}))
    for (const std::string& name : cases) compare_with_plans(name, n, options, report, progress);
}

}  // namespace boxstream::bench
