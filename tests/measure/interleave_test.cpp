// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "measure/interleave.hpp"
#include "measure/stopwatch.hpp"

namespace boxstream::measure_test {
namespace {

using namespace measure;

TEST(Interleave, ContestantsAlternate) {
  std::string order;
  const Interleaving rules{3, 0, 60, 1000};
  const auto series = measure_interleaved({{[&] { order += 'a'; }}, {[&] { order += 'b'; }}}, rules, [](int) {});
  EXPECT_EQ(series.size(), 2u);
  EXPECT_EQ(order, "abababab");  // once each to see how long it takes, then the rounds
}

TEST(Interleave, GoesBackAndForthWithTheControlLast) {
  std::vector<std::size_t> order;
  (void)interleave_with_control(3, 3, [&](std::size_t i) {
    order.push_back(i);
    return 1.0;
  });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 0, 0, 2, 1, 0, 0, 1, 2, 0}));
}

TEST(Interleave, KeepsTheTimesOfEachCandidate) {
  const Costs costs = interleave_with_control(2, 3, [](std::size_t i) { return i == 0 ? 1.0 : 5.0; });
  ASSERT_EQ(costs.of.size(), 2U);
  EXPECT_EQ(costs.of[0].median, 1);
  EXPECT_EQ(costs.of[1].median, 5);
  EXPECT_EQ(costs.control_spread, 0);
}

TEST(Interleave, AControlThatDiffersIsSeen) {
  // The first of each round is one series of the candidate, the last the other; two rounds are mirrored.
  const std::vector<double> times{4, 5, 5, 4};
  std::size_t at = 0;
  EXPECT_DOUBLE_EQ(interleave_with_control(1, 2, [&](std::size_t) { return times[at++]; }).control_spread, 0.2);
}

TEST(Interleave, CountsNothingWithoutCallgrind) {
  const Costs costs = interleave_with_control(1, 1, [](std::size_t) { return time_once([] {}); });
  EXPECT_TRUE(std::isnan(counted_instructions()));
  EXPECT_TRUE(std::isnan(costs.of[0].instructions));
}

}  // namespace
}  // namespace boxstream::measure_test
