// SPDX-License-Identifier: MIT
#include "suites/predictor.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace boxstream::bench {

namespace {

/// No peer takes long for this number of boxes.
constexpr std::size_t small_n = 2000;

}  // namespace

void Predictor::add(const std::string& key, std::size_t n, double ms) {
  runs_[key][n] = ms;
}

double Predictor::predict(const std::string& key, std::size_t n, double limit_ms,
                          const std::function<double(std::size_t)>& run) {
  if (n <= small_n) return 0;
  std::map<std::size_t, double>& runs = runs_[key];
  // Runs of a few boxes do not predict those of many.
  const auto known = [&] {
    return std::distance(runs.lower_bound(std::min<std::size_t>(n / 100, 1000)), runs.lower_bound(n));
  };
  for (const std::size_t smaller : {n / 100, n / 10}) {
    if (known() >= 2) break;
    if (runs.count(smaller)) continue;
    const double ms = run(smaller);
    runs[smaller] = ms;
    // Time grows at least as n.
    const double at_least = ms * static_cast<double>(n) / static_cast<double>(smaller);
    if (at_least > limit_ms) return at_least;
  }
  auto last = runs.lower_bound(n);
  if (last == runs.begin()) return 0;
  const auto [large_n, large_ms] = *--last;
  double power = 1.2;
  if (last != runs.begin()) {
    const auto [less_n, less_ms] = *--last;
    power = std::log(large_ms / less_ms) / std::log(static_cast<double>(large_n) / static_cast<double>(less_n));
  }
  return large_ms * std::pow(static_cast<double>(n) / static_cast<double>(large_n), std::clamp(power, 0.8, 2.0));
}

}  // namespace boxstream::bench
