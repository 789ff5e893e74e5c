// SPDX-License-Identifier: MIT
#include "accuracy/work_precision.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace boxstream::accuracy_test {
namespace {

using namespace accuracy;

TEST(Front, IsWhatNoOtherBeats) {
  const double nan = std::nan("");
  const std::vector<Offer> offers{{4, 1}, {1, 9}, {2, 5}, {3, 5}, {2, 7}, {nan, 0}, {0.5, nan}, {5, 1}};
  EXPECT_EQ(front(offers), (std::vector<std::size_t>{1, 2, 0}));
  EXPECT_TRUE(front({}).empty());
}

}  // namespace
}  // namespace boxstream::accuracy_test
