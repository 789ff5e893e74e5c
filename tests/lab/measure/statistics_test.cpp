// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "measure/interleave.hpp"

namespace boxstream::measure_test {
namespace {

using namespace measure;

TEST(Quantile, IsTheSmallestValueNotExceeded) {
  EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(quantile({3, 1, 2, 4}, 0.5), 2);
  EXPECT_EQ(quantile({3, 1, 2, 4}, 1), 4);
  EXPECT_EQ(quantile({3, 1, 2, 4}, 0), 1);
  EXPECT_EQ(quantile({7}, 0.95), 7);
}

TEST(Median, OfAnEvenNumberIsTheMeanOfTheMiddleTwo) {
  EXPECT_EQ(summarize({3.0, 1.0, 2.0}).median, 2.0);
  EXPECT_EQ(summarize({3.0, 1.0, 2.0}).min, 1.0);
  EXPECT_EQ(summarize({4.0, 1.0, 2.0, 100.0}).median, 3.0);
  EXPECT_EQ(summarize({}).samples, 0u);
}

TEST(Estimate, OfEqualValuesHasNoWidth) {
  const Estimate e = estimate(std::vector<double>(9, 2.5));
  EXPECT_EQ(e.median, 2.5);
  EXPECT_EQ(e.low, 2.5);
  EXPECT_EQ(e.high, 2.5);
}

/// Its promise, counted: 300 series of nine normal values whose median is 0. Of nine values a bootstrap interval has it
/// a little less often than 95 times in 100; the bounds are four standard errors around 0.93.
TEST(Estimate, IntervalHasTheMedianAsOftenAsItSays) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  int inside = 0;
  for (int series = 0; series < 300; ++series) {
    std::vector<double> values(9);
    for (double& value : values) value = normal(random);
    const Estimate e = estimate(values);
    EXPECT_LE(e.low, e.median);
    EXPECT_LE(e.median, e.high);
    inside += e.low <= 0 && 0 <= e.high;
  }
  EXPECT_GE(inside, 260);
  EXPECT_LE(inside, 297);
}

}  // namespace
}  // namespace boxstream::measure_test
