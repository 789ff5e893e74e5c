// SPDX-License-Identifier: MIT
#include "race.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace boxstream::bench {

namespace {

struct Runner {
  const Way* way;
  std::optional<bool> equal;
  Series series;
};

bool is_best_of_family(const std::vector<Runner>& runners, const Runner& runner) {
  return std::none_of(runners.begin(), runners.end(), [&](const Runner& other) {
    return other.way->family == runner.way->family && other.series.median < runner.series.median;
  });
}

}  // namespace

void race(const Row& row, const std::function<void()>& ours, std::vector<Way> ways, const Options& options,
          Report& report, Progress& progress) {
  std::erase_if(ways, [&](const Way& way) {
    return !options.peers.empty() &&
           std::find(options.peers.begin(), options.peers.end(), way.family) == options.peers.end();
  });
  std::vector<Runner> runners;
  std::vector<Contestant> contestants;
  for (const Way& way : ways) {
    if (!way.run) continue;
    progress.show(fmt::format("{} {} n={}: {}", row.suite, row.case_name, row.n, way.name));
    way.run();
    runners.push_back({&way, way.equal ? std::optional(way.equal()) : std::nullopt, {}});
    contestants.push_back({way.run});
  }
  contestants.push_back({ours});
  const std::vector<Series> series = measure_interleaved(contestants, options.interleaving, [](int) {});
  progress.clear();
  for (std::size_t i = 0; i < runners.size(); ++i) runners[i].series = series[i];

  Row measured = row;
  measured.ours_ms = series.back().median;
  measured.ours_min = series.back().min;
  for (const Runner& runner : runners) {
    if (runner.equal != false && !is_best_of_family(runners, runner)) continue;
    Row result = measured;
    result.peer = runner.way->name;
    result.yardstick = runner.way->yardstick;
    result.peer_ms = runner.series.median;
    result.peer_min = runner.series.min;
    result.samples = runner.series.samples;
    result.pairs_equal = runner.equal;
    report.add(std::move(result));
  }
  for (const Way& way : ways) {
    if (way.run) continue;
    Row result = measured;
    result.peer = way.name;
    result.skipped = way.skipped;
    report.add(std::move(result));
  }
}

}  // namespace boxstream::bench
