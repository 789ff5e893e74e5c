// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "accuracy/stopwatch.hpp"
#include "accuracy/turns.hpp"

namespace boxstream::accuracy_test {
namespace {

using namespace accuracy;

TEST(Turns, GoForwardsAndBackwardsWithTheTwinLast) {
  std::vector<std::size_t> order;
  (void)take_turns(3, 3, [&](std::size_t i) {
    order.push_back(i);
    return 1.0;
  });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 0, 0, 2, 1, 0, 0, 1, 2, 0}));
}

TEST(Turns, KeepsTheTimesOfCandidatesApart) {
  const Turns turns = take_turns(2, 3, [](std::size_t i) { return i == 0 ? 1.0 : 5.0; });
  ASSERT_EQ(turns.costs.size(), 2U);
  EXPECT_EQ(turns.costs[0].median, 1);
  EXPECT_EQ(turns.costs[1].median, 5);
  EXPECT_EQ(turns.twin_spread, 0);
}

TEST(Turns, TwinsThatDifferAreSeen) {
  // The first of each round is one series of the candidate, the last the other; two rounds are mirrored.
  const std::vector<double> times{4, 5, 5, 4};
  std::size_t at = 0;
  EXPECT_DOUBLE_EQ(take_turns(1, 2, [&](std::size_t) { return times[at++]; }).twin_spread, 0.2);
}

TEST(Turns, CountNothingWithoutCallgrind) {
  const Turns turns = take_turns(1, 1, [](std::size_t) { return stopwatch([] {}); });
  EXPECT_TRUE(std::isnan(counted_instructions()));
  EXPECT_TRUE(std::isnan(turns.costs[0].instructions));
}

}  // namespace
}  // namespace boxstream::accuracy_test
