// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "accuracy/knob.hpp"
#include "accuracy/measure.hpp"

namespace boxstream::accuracy_test {
namespace {

using namespace accuracy;
using Kind = Measure::Kind;

TEST(Measure, EveryNameIsRead) {
  std::size_t own = 0;
  for (const std::string& name : measure_names()) {
    const Measure measure = parse_measure(name);
    EXPECT_EQ(measure.name, name);
    own += measure.kind != Kind::metric;
  }
  EXPECT_EQ(own, static_cast<std::size_t>(Kind::repeatable));
  EXPECT_EQ(parse_measure("momentum_drift").kind, Kind::momentum_drift);
  EXPECT_EQ(parse_measure("stands").kind, Kind::stands);
  EXPECT_EQ(parse_measure("repeatable").kind, Kind::repeatable);
}

TEST(Measure, StatisticIsBehindADot) {
  const Measure measure = parse_measure("penetration.p95");
  EXPECT_EQ(measure.metric, scenes::Check::Metric::max_penetration);
  EXPECT_EQ(measure.statistic, Measure::Statistic::p95);
  EXPECT_THROW(parse_measure("penetration.median"), BadKnob);
  EXPECT_THROW(parse_measure("penetration."), BadKnob);
}

TEST(Measure, SumsUp) {
  const Measure largest = parse_measure("penetration"), smallest = parse_measure("lowest");
  const std::vector<double> values{3, 1, 2, 4};
  const Series series = summed_up(largest, values, 8);
  EXPECT_EQ(series.worst, 4);
  EXPECT_EQ(series.mean, 2.5);
  EXPECT_EQ(series.last, 4);
  EXPECT_EQ(series.integral, 20);
  EXPECT_EQ(series.of(parse_measure("penetration.integral")), 20);
  EXPECT_EQ(summed_up(smallest, values, 8).worst, 1);
}

TEST(Measure, ChangeKeepsItsSign) {
  EXPECT_EQ(summed_up(parse_measure("energy_change"), {0.1, -0.5, 0.2}, 1).worst, -0.5);
  EXPECT_EQ(summed_up(parse_measure("energy_change"), {0.1, 0.5, -0.2}, 1).worst, 0.5);
}

TEST(Measure, KnowsWhichValuesAreBetter) {
  std::vector<std::string> high;
  for (const std::string& name : measure_names())
    if (better(parse_measure(name)) == Better::high) high.push_back(name);
  EXPECT_EQ(high, (std::vector<std::string>{"finite", "collapse_time", "stands", "agrees_for", "repeatable"}));
  // A place, or an energy, is right or wrong, and not better the more of it there is.
  for (const char* name : {"lowest", "highest", "energy", "max_speed", "y", "spin"})
    EXPECT_EQ(better(parse_measure(name)), Better::as_reference) << name;
  EXPECT_EQ(better(parse_measure("energy_change.last")), Better::near_zero);
  EXPECT_EQ(better(parse_measure("trajectory_until")), Better::low);
}

TEST(Measure, WhatIsNoNumberSpoilsAll) {
  const Series series = summed_up(parse_measure("energy"), {1, std::nan(""), 2}, 1);
  EXPECT_TRUE(std::isnan(series.worst));
  EXPECT_TRUE(std::isnan(series.last));
}

}  // namespace
}  // namespace boxstream::accuracy_test
