// SPDX-License-Identifier: MIT
#include "suites/race.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace boxstream::bench {

bool Race::is_best_of_family(const Method& method) const {
  return std::none_of(methods_.begin(), methods_.end(), [&](const Method& other) {
    return other.run && other.family == method.family && other.series.median < method.series.median;
  });
}

void Race::run(const std::function<void()>& ours) {
  std::erase_if(methods_, [&](const Method& method) { return !options_.wants_peer(method.family); });
  // Those that are skipped come last.
  const auto skipped = std::stable_partition(methods_.begin(), methods_.end(), [](const Method& m) { return m.run; });
  std::vector<Contestant> contestants;
  for (auto method = methods_.begin(); method != skipped; ++method) {
    progress_.show(fmt::format("{} {} n={}: {}", row.suite, row.case_name, row.n, method->name));
    method->run();
    if (method->equal) method->is_equal = method->equal();
    contestants.push_back({method->run});
  }
  contestants.push_back({ours});
  std::vector<Series> series = measure_interleaved(contestants, options_.interleaving, [](int) {});
  progress_.clear();
  for (Series& each : series) {
    each.median /= units;
    each.min /= units;
  }
  for (std::size_t i = 0; i + 1 < series.size(); ++i) methods_[i].series = series[i];

  row.set_ours(series.back());
  for (const Method& method : methods_) {
    if (method.run && method.is_equal != false && !is_best_of_family(method)) continue;
    Row result = row;
    result.peer = method.name;
    result.skipped = method.skipped;
    if (method.run) {
      result.yardstick = method.yardstick;
      result.set_peer(method.series);
      result.pairs_equal = method.is_equal;
    }
    report_.add(std::move(result));
  }
}

}  // namespace boxstream::bench
