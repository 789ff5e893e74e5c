// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "inputs/batches.hpp"
#include "peers/radix_sort.hpp"
#include "suites/predictor.hpp"

namespace boxstream::bench {
namespace {

TEST(Predictor, FollowsThePowerLaw) {
  Predictor predictor;
  std::vector<std::size_t> runs;
  const auto quadratic = [&](std::size_t n) {
    runs.push_back(n);
    return 1e-6 * static_cast<double>(n * n);
  };
  EXPECT_NEAR(predictor.predict("key", 100000, 1e9, quadratic), 1e4, 1);
  EXPECT_EQ(runs, (std::vector<std::size_t>{1000, 10000}));
  // What is known is not run again.
  predictor.add("key", 100000, 1e4);
  EXPECT_NEAR(predictor.predict("key", 1000000, 1e9, quadratic), 1e6, 100);
  EXPECT_EQ(runs.size(), 2u);
}

TEST(Predictor, StopsAsSoonAsTheLimitIsPassed) {
  Predictor predictor;
  int runs = 0;
  EXPECT_GT(predictor.predict("key", 100000, 10, [&](std::size_t) { return ++runs, 1.0; }), 10);
  EXPECT_EQ(runs, 1);
}

TEST(Predictor, SmallSizesNeedNoPrediction) {
  Predictor predictor;
  EXPECT_EQ(predictor.predict("key", 100, 10, [](std::size_t) -> double { throw std::logic_error("was run"); }), 0);
}

TEST(RadixSort, SortsByTheLowEnds) {
  std::vector<Aabb> boxes = batches::make("X", 3000, 1);  // negative, positive and huge ones
  boxes[5].min[0] = -0.0f;
  RadixSort sort;
  for (int again = 0; again < 2; ++again) {
    const Span<const std::uint64_t> sorted = sort.sort(boxes);
    ASSERT_EQ(sorted.size(), boxes.size());
    std::vector<bool> seen(boxes.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      seen[RadixSort::index(sorted[i])] = true;
      if (i > 0) {
        ASSERT_LE(boxes[RadixSort::index(sorted[i - 1])].min[0], boxes[RadixSort::index(sorted[i])].min[0]);
      }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 3000);
  }
}

}  // namespace
}  // namespace boxstream::bench
