// SPDX-License-Identifier: MIT
#include "inputs/motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "inputs/batches.hpp"

namespace boxstream::bench {
namespace {

double side(const Aabb& box, int d) {
  return static_cast<double>(box.max[d]) - static_cast<double>(box.min[d]);
}

class EachMotion : public testing::TestWithParam<Motion> {};

TEST_P(EachMotion, IsAPureFunctionThatKeepsSizes) {
  const std::vector<Aabb> start = batches::make("C", 1000, 1);
  MovingBoxes one(start, GetParam(), 3), other(start, GetParam(), 3);
  for (int frame = 0; frame < 5; ++frame) {
    one.next_frame();
    other.next_frame();
    for (std::size_t i = 0; i < start.size(); ++i) {
      ASSERT_EQ(one.boxes()[i], other.boxes()[i]);
      for (int d = 0; d < 3; ++d) ASSERT_NEAR(side(one.boxes()[i], d), side(start[i], d), 1e-4);
    }
  }
}

TEST_P(EachMotion, BoxesThatAreNotListedRest) {
  const std::vector<Aabb> start = batches::make("C", 1000, 1);
  MovingBoxes moving(start, GetParam(), 3);
  moving.next_frame();
  ASSERT_TRUE(std::is_sorted(moving.moved().begin(), moving.moved().end()));
  for (std::uint32_t i = 0; i < start.size(); ++i)
    if (!std::binary_search(moving.moved().begin(), moving.moved().end(), i)) {
      ASSERT_EQ(moving.boxes()[i], start[i]);
    }
}

INSTANTIATE_TEST_SUITE_P(Motions, EachMotion,
                         testing::Values(Motion::brown, Motion::static5, Motion::one, Motion::fall, Motion::teleport,
                                         Motion::asleep, Motion::tremble),
                         [](const auto& instance) {
                           for (const MotionName& m : motions())
                             if (m.motion == instance.param) return std::string(m.name);
                           return std::string("nameless");
                         });

TEST(Motions, BrownMovesUpToATenthOfTheOwnSide) {
  const std::vector<Aabb> start = batches::make("M", 2000, 1);
  MovingBoxes moving(start, Motion::brown, 1);
  moving.next_frame();
  double furthest = 0;
  for (std::size_t i = 0; i < start.size(); ++i)
    for (int d = 0; d < 3; ++d) {
      const double moved =
          std::fabs(static_cast<double>(moving.boxes()[i].min[d]) - static_cast<double>(start[i].min[d]));
      ASSERT_LE(moved, 0.1 * side(start[i], d) + 1e-5);
      furthest = std::max(furthest, moved / side(start[i], d));
    }
  EXPECT_GT(furthest, 0.09);
  EXPECT_EQ(moving.moved().size(), start.size());
}

TEST(Motions, Static5MovesATwentieth) {
  const MovingBoxes moving(batches::make("U", 20000, 1), Motion::static5, 1);
  EXPECT_NEAR(static_cast<double>(moving.moved().size()), 1000, 100);
}

TEST(Motions, FallAcceleratesDownwards) {
  const std::vector<Aabb> start = batches::make("D", 1000, 1);
  MovingBoxes moving(start, Motion::fall, 1);
  double last = 0;
  for (int frame = 1; frame <= 20; ++frame) {
    const double before = static_cast<double>(moving.boxes()[7].min[1]);
    moving.next_frame();
    const double fallen = before - static_cast<double>(moving.boxes()[7].min[1]);
    EXPECT_GT(fallen, last);
    last = fallen;
    EXPECT_EQ(moving.boxes()[7].min[0], start[7].min[0]);
  }
  // 20 accelerations of 0.003 mean sides, which are 1, and the start speed.
  EXPECT_GT(last, 0.059);
  EXPECT_LT(last, 0.112);
}

TEST(Motions, TeleportKeepsThePlacesThereAre) {
  const std::vector<Aabb> start = batches::make("G", 1000, 1);  // equal cubes
  MovingBoxes moving(start, Motion::teleport, 1);
  moving.next_frame();
  const auto less = [](const Aabb& a, const Aabb& b) {
    return std::lexicographical_compare(a.min, a.min + 3, b.min, b.min + 3);
  };
  std::vector<Aabb> before = start, after(moving.boxes().begin(), moving.boxes().end());
  EXPECT_FALSE(std::equal(before.begin(), before.end(), after.begin()));
  std::sort(before.begin(), before.end(), less);
  std::sort(after.begin(), after.end(), less);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
}

TEST(Motions, AsleepSetsAllAgain) {
  const std::vector<Aabb> start = batches::make("U", 500, 1);
  MovingBoxes moving(start, Motion::asleep, 1);
  moving.next_frame();
  EXPECT_EQ(moving.moved().size(), start.size());
  EXPECT_TRUE(std::equal(start.begin(), start.end(), moving.boxes().begin()));
}

TEST(Motions, TremblingStaysAboutTheStart) {
  const std::vector<Aabb> start = batches::make("U", 500, 1);
  MovingBoxes moving(start, Motion::tremble, 1);
  for (int frame = 0; frame < 30; ++frame) moving.next_frame();
  EXPECT_FALSE(std::equal(start.begin(), start.end(), moving.boxes().begin()));
  for (std::size_t i = 0; i < start.size(); ++i)
    ASSERT_LE(std::abs(moving.boxes()[i].min[1] - start[i].min[1]), 0.0011f * side(start[i], 1)) << i;
}

TEST(Motions, ScalingIsByAPowerOfTwoToSidesOfAboutOne) {
  const std::vector<Aabb> boxes = batches::make("U", 1000, 1), scaled = scaled_to_unit_sides(boxes);
  const float factor = scaled[0].min[0] / boxes[0].min[0];
  int exponent;
  EXPECT_EQ(std::frexp(factor, &exponent), 0.5f);
  double mean = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    mean += side(scaled[i], 0) / 1000;
    ASSERT_EQ(scaled[i].max[1], boxes[i].max[1] * factor);
  }
  EXPECT_GT(mean, 0.7);
  EXPECT_LT(mean, 1.45);
}

}  // namespace
}  // namespace boxstream::bench
