// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
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

TEST(Interleave, EachRoundHasEveryContestantOnceInAnotherOrder) {
  const Interleaving rules{50, 0, 60, 1000};
  std::vector<std::string> rounds;
  interleave(
      4, rules, Order::shuffled, [&](int) { rounds.emplace_back(); },
      [&](int, std::size_t i) { rounds.back() += static_cast<char>('a' + i); });
  ASSERT_EQ(rounds.size(), 50U);
  for (std::string round : rounds) {
    std::sort(round.begin(), round.end());
    EXPECT_EQ(round, "abcd");
  }
  std::sort(rounds.begin(), rounds.end());
  EXPECT_GT(std::unique(rounds.begin(), rounds.end()) - rounds.begin(), 12);  // of 24
}

TEST(Interleave, EachIsPrecededByEveryOther) {
  std::set<std::pair<std::size_t, std::size_t>> neighbours;
  std::size_t before = 0;
  interleave(
      3, {60, 0, 60, 1000}, Order::shuffled, [](int) {},
      [&](int, std::size_t i) {
        neighbours.emplace(before, i);
        before = i;
      });
  EXPECT_EQ(neighbours.size(), 9U);
}

TEST(Interleave, ATurnIsTheMedianOfItsCalls) {
  // The first call of each turn finds cold caches.
  bool is_first = false;
  int turns = 0, calls = 0;
  const Costs costs = interleave_with_control(
      2, 3,
      [&](std::size_t) {
        ++calls;
        return std::exchange(is_first, false) ? 100.0 : 1.0;
      },
      [&](std::size_t) {
        ++turns;
        is_first = true;
      });
  EXPECT_EQ(turns, 3 * 3);
  EXPECT_EQ(calls, turns * most_calls_in_turn);
  EXPECT_EQ(costs.of[0].high, 1);
  EXPECT_EQ(costs.of[1].high, 1);
}

TEST(Interleave, ALongCallIsATurn) {
  int calls = 0;
  (void)interleave_with_control(1, 2, [&](std::size_t) {
    ++calls;
    const Elapsed elapsed;
    while (elapsed.milliseconds() < turn_ms) {
    }
    return 1.0;
  });
  EXPECT_EQ(calls, 2 * 2);
}

TEST(Interleave, KeepsTheTimesOfEachCandidate) {
  const Costs costs = interleave_with_control(2, 3, [](std::size_t i) { return i == 0 ? 1.0 : 5.0; });
  ASSERT_EQ(costs.of.size(), 2U);
  EXPECT_EQ(costs.of[0].median, 1);
  EXPECT_EQ(costs.of[1].median, 5);
  EXPECT_EQ(costs.control_spread, 0);
}

TEST(Interleave, AControlThatDiffersIsSeen) {
  // One turn of the candidate costs 4, that of its control 5, or the other way round.
  double next = 3, cost = 0;
  const double spread = interleave_with_control(
                            1, 1, [&](std::size_t) { return cost; }, [&](std::size_t) { cost = ++next; })
                            .control_spread;
  EXPECT_TRUE(std::abs(spread - 0.2) < 1e-12 || std::abs(spread - 0.25) < 1e-12) << spread;
}

TEST(Interleave, CountsNothingWithoutCallgrind) {
  const Costs costs = interleave_with_control(1, 1, [](std::size_t) { return time_once([] {}); });
  EXPECT_TRUE(std::isnan(counted_instructions()));
  EXPECT_TRUE(std::isnan(costs.of[0].instructions));
}

}  // namespace
}  // namespace boxstream::measure_test
