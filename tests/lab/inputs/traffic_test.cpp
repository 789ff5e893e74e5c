// SPDX-License-Identifier: MIT
#include "inputs/traffic.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>
#include <string>

namespace boxstream::batches {
namespace {

std::uint64_t pairs_of(const Traffic& traffic) {
  Detector detector;
  std::vector<Pair> pairs;
  return find_near_pairs(detector, Span<const Ball64>(traffic.objects), traffic.safety_distance, pairs).pairs;
}

bool same_bits(const std::vector<Ball64>& a, const std::vector<Ball64>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Ball64)) == 0;
}

TEST(Traffic, IsAFunctionOfItsSeed) {
  for (const char* const name : {"air", "sea"}) {
    const Traffic traffic = make_traffic(name, 1000, 1);
    EXPECT_TRUE(same_bits(traffic.objects, make_traffic(name, 1000, 1).objects));
    EXPECT_FALSE(same_bits(traffic.objects, make_traffic(name, 1000, 2).objects));
    EXPECT_EQ(make_traffic(name, 0, 1).objects.size(), 0u);
    EXPECT_EQ(make_traffic(name, 1, 1).objects.size(), 1u);
  }
  EXPECT_THROW(make_traffic("rail", 10, 1), std::invalid_argument);
}

/// Aircraft between the ground and 41 000 ft, most of them at cruising levels; ships of 15 m to 400 m at sea level.
TEST(Traffic, IsWhereItMayBe) {
  std::size_t cruising = 0;
  for (const Ball64& ball : make_traffic("air", 5000, 3).objects) {
    EXPECT_EQ(ball.radius, 0);
    EXPECT_GE(ball.centre[2], 0);
    EXPECT_LT(ball.centre[2], 5 * 41);
    cruising += ball.centre[2] > 5 * 27.5;
  }
  EXPECT_GT(cruising, 2500u);
  for (const Ball64& ball : make_traffic("sea", 5000, 3).objects) {
    EXPECT_EQ(ball.centre[2], 0);
    EXPECT_GE(2 * ball.radius * 1852, 14);
    EXPECT_LE(2 * ball.radius * 1852, 401);
  }
}

/// Every 2000 have a region of their own, so that there are about as many conflicts for each.
TEST(Traffic, IsAsDenseForAnyNumber) {
  for (const char* const name : {"air", "sea"})
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      SCOPED_TRACE(std::string(name) + ", seed " + std::to_string(seed));
      const auto each = [&](std::size_t n) {
        return static_cast<double>(pairs_of(make_traffic(name, n, seed))) / static_cast<double>(n);
      };
      // One region is a matter of luck, many are not.
      for (const std::size_t n : {500u, 2000u}) {
        EXPECT_GT(each(n), 0.02);
        EXPECT_LT(each(n), 0.5);
      }
      const double many = each(20'000);
      EXPECT_GT(each(60'000), 0.8 * many);
      EXPECT_LT(each(60'000), 1.25 * many);
    }
}

}  // namespace
}  // namespace boxstream::batches
