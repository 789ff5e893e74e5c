// SPDX-License-Identifier: MIT
#include "boxes/fat_boxes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "boxes/pair_difference.hpp"
#include "inputs/batches.hpp"
#include "inputs/motion.hpp"

namespace boxstream::report {
namespace {

using bench::Brownian;
using bench::MovingBoxes;

class EachMargin : public testing::TestWithParam<double> {};

TEST_P(EachMargin, HasAllPairsOfEachFrame) {
  FatBoxes fat(GetParam(), true);
  MovingBoxes moving(batches::make("D", 300, 1), Brownian{0.7, 0.02}, 1);
  std::vector<Pair> pairs;
  fat.find_pairs(moving.boxes(), pairs);
  for (int frame = 0; frame < 30; ++frame) {
    std::sort(pairs.begin(), pairs.end());
    ASSERT_EQ(pairs, all_against_all(moving.boxes())) << "frame " << frame;
    moving.next_frame();
    fat.next_frame(moving.boxes(), moving.moved(), pairs);
  }
}

INSTANTIATE_TEST_SUITE_P(Margins, EachMargin, testing::Values(0.0, 0.001, 0.05, 0.5));

TEST(FatBoxes, WithoutMarginHasNoExtraPairs) {
  FatBoxes fat(0, false);
  MovingBoxes moving(batches::make("D", 300, 1), Brownian{1, 0.1}, 1);
  std::vector<Pair> pairs;
  fat.find_pairs(moving.boxes(), pairs);
  for (int frame = 0; frame < 5; ++frame) {
    moving.next_frame();
    fat.next_frame(moving.boxes(), moving.moved(), pairs);
    EXPECT_EQ(fat.exits(), 300u);
    ASSERT_EQ(pairs.size(), all_against_all(moving.boxes()).size());
  }
}

TEST(FatBoxes, CountsExits) {
  std::vector<Aabb> boxes{{{0, 0, 0}, {1, 1, 1}}, {{1.25F, 0, 0}, {2.25F, 1, 1}}};
  const std::vector<std::uint32_t> first{0};
  FatBoxes fat(0.25, false);
  std::vector<Pair> pairs;
  fat.find_pairs(boxes, pairs);
  EXPECT_EQ(pairs.size(), 1u) << "fat boxes touch, boxes do not";
  const auto place = [&](float x) {
    boxes[0].min[0] = x;
    boxes[0].max[0] = x + 1;
    fat.next_frame(boxes, first, pairs);
    return fat.exits();
  };
  EXPECT_EQ(place(0.25F), 0u) << "up to the end of its fat box";
  EXPECT_EQ(place(-0.5F), 1u);
  EXPECT_EQ(pairs.size(), 0u);
  EXPECT_EQ(place(-0.625F), 0u) << "the fat box is a new one";
}

TEST(FatBoxes, StartsAfresh) {
  FatBoxes fat(0.1, true);
  const std::vector<Aabb> many = batches::make("D", 100, 1), few = batches::make("D", 50, 2);
  std::vector<Pair> pairs;
  fat.find_pairs(many, pairs);
  fat.find_pairs(few, pairs);
  std::sort(pairs.begin(), pairs.end());
  EXPECT_EQ(pairs, all_against_all(Span<const Aabb>(few)));
}

TEST(Brownian, MovesTheShareBySteps) {
  const std::vector<Aabb> start = batches::make("D", 2000, 1);
  MovingBoxes moving(start, Brownian{0.25, 0.01}, 3);
  EXPECT_NEAR(static_cast<double>(moving.moved().size()), 500, 60);
  moving.next_frame();
  for (const std::uint32_t i : moving.moved()) {
    const float side = start[i].max[0] - start[i].min[0];
    ASSERT_LE(std::abs(moving.boxes()[i].min[0] - start[i].min[0]), 0.0101F * side);
  }
}

}  // namespace
}  // namespace boxstream::report
