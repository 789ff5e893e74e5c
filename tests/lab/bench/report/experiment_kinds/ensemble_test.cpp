// SPDX-License-Identifier: MIT
#include "experiment_kinds/ensemble.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace boxstream::report {
namespace {

/// Runs that part from 1e-9 m on by `rate`, each disturbed by a factor of its own in each step, until they are a metre
/// apart.
Ensemble exponential(double rate, double noise, std::size_t runs = 20) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  Ensemble ensemble{0.01, {}};
  for (std::size_t i = 0; i < runs; ++i) {
    std::vector<double>& run = ensemble.distances.emplace_back();
    for (int step = 1; step <= 1000; ++step)
      run.push_back(std::min(1.0, 1e-9 * std::exp(rate * 0.01 * step + noise * normal(random))));
  }
  return ensemble;
}

TEST(Ensemble, RateIsThatOfAnExponential) {
  const GrowthRate growth = growth_rate(exponential(5, 0), {1e-7, 1e-2});
  EXPECT_NEAR(growth.per_second, 5, 1e-9);
  EXPECT_NEAR(growth.low, 5, 1e-9);
  EXPECT_NEAR(growth.high, 5, 1e-9);
  // ln 1e5 / 5 seconds.
  EXPECT_NEAR(static_cast<double>(growth.steps), 230, 1);
}

TEST(Ensemble, IntervalHasTheRateAndIsNarrowForManyRuns) {
  const GrowthRate few = growth_rate(exponential(5, 0.5, 20), {1e-7, 1e-2});
  EXPECT_LT(few.low, 5);
  EXPECT_GT(few.high, 5);
  const GrowthRate many = growth_rate(exponential(5, 0.5, 500), {1e-7, 1e-2});
  EXPECT_LT(many.high - many.low, (few.high - few.low) / 3);
}

TEST(Ensemble, WhatDoesNotGrowIntoTheWindowHasNoRate) {
  EXPECT_TRUE(std::isnan(growth_rate(exponential(0.1, 0), {1e-7, 1e-2}).per_second));
}

TEST(Ensemble, WhatLeapsThroughTheWindowHasNoRate) {
  EXPECT_TRUE(std::isnan(growth_rate(exponential(500, 0), {1e-7, 1e-2}).per_second));
}

TEST(Ensemble, RunsThatAreTheSameDoNotCount) {
  Ensemble ensemble = exponential(5, 0);
  ensemble.distances.emplace_back(1000, 0.0);
  EXPECT_NEAR(growth_rate(ensemble, {1e-7, 1e-2}).per_second, 5, 1e-9);
}

TEST(Ensemble, QuantilesAndTimesAreThoseOfTheRuns) {
  // Run i has i + 1 metres after step i, and stays there.
  Ensemble ensemble{0.5, {}};
  for (std::size_t i = 0; i < 10; ++i) {
    ensemble.distances.emplace_back(10, 0.0);
    std::fill(ensemble.distances[i].begin() + static_cast<std::ptrdiff_t>(i), ensemble.distances[i].end(), i + 1.0);
  }
  EXPECT_EQ(quantile_over_runs(ensemble, 0.5).back(), 5);
  EXPECT_EQ(quantile_over_runs(ensemble, 0.9).back(), 9);
  EXPECT_EQ(quantile_over_runs(ensemble, 0.5).front(), 0);
  EXPECT_EQ(time_until(ensemble, 0.5, 0.1), 0.5);
  EXPECT_EQ(time_until(ensemble, 0.5, 0.5), 2.5);
  // Nine never are more than nine metres away: their time is that of the run.
  EXPECT_EQ(time_until(ensemble, 9.5, 0.1), 5);
}

}  // namespace
}  // namespace boxstream::report
