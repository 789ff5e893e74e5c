// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace boxstream::report {

/// How far each of several runs is from the one that was not perturbed, after each step.
struct Ensemble {
  double dt = 0;
  std::vector<std::vector<double>> distances;  ///< of each run; all of one length
};

/// The distance after each step that a share `p` of the runs does not exceed.
std::vector<double> quantile_over_runs(const Ensemble& ensemble, double p);

/// The time after which a share `p` of the runs has been further away than `limit` once; of those that never are, the
/// length of the runs.
double time_until(const Ensemble& ensemble, double limit, double p);

/// The rate of an exponential growth, with an interval that has it in 95 of 100 ensembles like this one.
struct GrowthRate {
  double per_second, low, high;
  std::size_t steps;  ///< that the line was fitted to
};

/// Where exponential growth is looked for: above what rounding makes, below what the scene lets grow no further.
/// Metres.
struct Window {
  double least, most;
};

/// The slope by least squares of the runs' mean logarithm of the distance over time, from the first step at which the
/// mean is in the window to the last one before it leaves it above; its interval by a bootstrap of 500 samples of runs
/// with a fixed seed. All NaN if there are fewer than `fewest_steps` steps.
GrowthRate growth_rate(const Ensemble& ensemble, const Window& window);

inline constexpr std::size_t fewest_steps = 5;

}  // namespace boxstream::report
