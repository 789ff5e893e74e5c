// SPDX-License-Identifier: MIT
#include "experiment_kinds/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "measure/interleave.hpp"

namespace boxstream::report {
namespace {

using Runs = std::vector<const std::vector<double>*>;

/// Of the runs' logarithms after a step. A run that has not moved at all has no logarithm, and does not count.
double mean_logarithm(const Runs& runs, std::size_t step) {
  double sum = 0, count = 0;
  for (const std::vector<double>* const run : runs) {
    if (!((*run)[step] > 0)) continue;
    sum += std::log((*run)[step]);
    ++count;
  }
  return sum / count;
}

/// Steps [begin, end).
struct Part {
  std::size_t begin, end;
};

Part exponential_part(const Runs& runs, const Window& window) {
  const std::size_t steps = runs.front()->size();
  const auto first = [&](std::size_t from, double limit) {
    while (from < steps && !(mean_logarithm(runs, from) >= std::log(limit))) ++from;
    return from;
  };
  const std::size_t begin = first(0, window.least);
  return {begin, first(begin, window.most)};
}

double slope(const Runs& runs, Part part, double dt) {
  const auto n = static_cast<double>(part.end - part.begin);
  const double middle = dt * (static_cast<double>(part.begin + part.end - 1) / 2);
  double products = 0, squares = 0;
  for (std::size_t step = part.begin; step < part.end; ++step) {
    const double time = dt * static_cast<double>(step) - middle;
    products += time * mean_logarithm(runs, step);
    squares += time * time;
  }
  return n < 2 ? NAN : products / squares;
}

}  // namespace

std::vector<double> quantile_over_runs(const Ensemble& ensemble, double p) {
  std::vector<double> all, of_step;
  for (std::size_t step = 0; step < ensemble.distances.front().size(); ++step) {
    of_step.clear();
    for (const std::vector<double>& run : ensemble.distances) of_step.push_back(run[step]);
    all.push_back(measure::quantile(of_step, p));
  }
  return all;
}

double time_until(const Ensemble& ensemble, double limit, double p) {
  std::vector<double> times;
  for (const std::vector<double>& run : ensemble.distances) {
    const auto beyond = std::find_if(run.begin(), run.end(), [&](double distance) { return distance > limit; });
    const auto steps = std::min(beyond - run.begin() + 1, run.end() - run.begin());
    times.push_back(static_cast<double>(steps) * ensemble.dt);
  }
  return measure::quantile(times, p);
}

GrowthRate growth_rate(const Ensemble& ensemble, const Window& window) {
  constexpr int samples = 500;
  Runs runs;
  for (const std::vector<double>& run : ensemble.distances) runs.push_back(&run);
  const Part part = exponential_part(runs, window);
  const std::size_t steps = part.end - part.begin;
  if (steps < fewest_steps) return {NAN, NAN, NAN, steps};
  std::mt19937_64 random(1);
  std::vector<double> slopes;
  Runs sample(runs.size());
  for (int i = 0; i < samples; ++i) {
    for (const std::vector<double>*& run : sample) run = runs[random() % runs.size()];
    slopes.push_back(slope(sample, part, ensemble.dt));
  }
  return {slope(runs, part, ensemble.dt), measure::quantile(slopes, 0.025), measure::quantile(slopes, 0.975), steps};
}

}  // namespace boxstream::report
