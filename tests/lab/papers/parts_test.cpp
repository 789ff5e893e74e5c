// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "papers/hybrid/approx_median.hpp"
#include "papers/hybrid/box.hpp"
#include "papers/hybrid/order.hpp"
#include "random.hpp"
#include "truth.hpp"

namespace boxstream::papers::tests {
namespace {

using boxstream::tests::Random;

void ignore(std::uint32_t, std::uint32_t) {}

TEST(Level, SamplesTheSameShareOfThePoints) {
  const Level level{900, 4};
  EXPECT_EQ(level(900), 4);
  EXPECT_EQ(level(2699), 4);
  EXPECT_EQ(level(2700), 5);
  EXPECT_EQ(level(8100), 6);
  EXPECT_EQ(level(899), 3);
  EXPECT_EQ(level(300), 3);
  EXPECT_EQ(level(299), 2);
  EXPECT_EQ(level(10), 0);
  EXPECT_EQ(level(0), 0);
}

TEST(ApproxMedian, MedianOfThree) {
  int values[] = {1, 2, 3};
  do EXPECT_EQ(median_of_3(values[0], values[1], values[2]), 2);
  while (std::next_permutation(values, values + 3));
  EXPECT_EQ(median_of_3(5, 5, 1), 5);
  EXPECT_EQ(median_of_3(1, 5, 1), 1);
}

/// The value returned is the low end of a point, and higher trees come nearer to the median.
TEST(ApproxMedian, ComesNearerWithEachLevel) {
  std::vector<NumberedBox> points;
  for (int i = 0; i < 1001; ++i) points.push_back({{{0, 1}, {2 * i, 2 * i + 1}, {0, 1}}, i});
  const Problem<Structures> problem({}, Case::complete, 2, ignore);
  double error[5] = {};
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    batches::Random random(seed);
    for (int h = 0; h < 5; ++h) {
      const auto median = approx_median(problem, Span<const NumberedBox>(points), h, 1, random);
      ASSERT_EQ(median % 2, 0) << "seed " << seed;
      ASSERT_TRUE(median >= 0 && median <= 2000) << "seed " << seed;
      error[h] += std::abs(median - 1000) / 300.0;
    }
  }
  // One point is off by a quarter of the range on average; each level takes off about a third of what is left.
  EXPECT_NEAR(error[0], 500, 60);
  for (int h = 1; h < 5; ++h) EXPECT_LT(error[h], 0.85 * error[h - 1]) << "height " << h;
}

TEST(KeepSorted, PartsInAStableWayAndMerges) {
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    std::vector<Box> boxes;
    for (std::size_t n = random.index(30); n > 0; --n) boxes.push_back({{{random.integer(0, 9), 10}, {0, 1}, {0, 1}}});
    const Problem<Pointers> problem({boxes.data()}, Case::complete, 2, ignore);
    std::vector<Pointer> pointers(boxes.size()), temporary(boxes.size());
    std::iota(pointers.begin(), pointers.end(), 0u);
    sort_by_low_end(problem, Span<Pointer>(pointers));
    const std::vector<Pointer> sorted = pointers;
    const KeepSorted<Pointer> order{temporary.data()};
    const auto belongs = [&](Pointer p) { return p % 3 == 1; };
    const std::size_t front = order.part(Span<Pointer>(pointers), belongs);
    std::vector<Pointer> expected = sorted;
    std::stable_partition(expected.begin(), expected.end(), belongs);
    ASSERT_EQ(pointers, expected) << "round " << round;
    order.join(problem, Span<Pointer>(pointers), front);
    std::vector<std::int32_t> ends, sorted_ends;
    for (const Pointer p : pointers) ends.push_back(problem.lo(p, 0));
    for (const Pointer p : sorted) sorted_ends.push_back(problem.lo(p, 0));
    ASSERT_EQ(ends, sorted_ends) << "round " << round;
    ASSERT_TRUE(std::is_permutation(pointers.begin(), pointers.end(), sorted.begin())) << "round " << round;
  }
}

}  // namespace
}  // namespace boxstream::papers::tests
