// SPDX-License-Identifier: MIT
#include "boxes/fat_boxes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "batches/batches.hpp"
#include "boxes/pair_difference.hpp"
#include "motion.hpp"

namespace boxstream::report {
namespace {

using bench::Brownian;
using bench::MovingBoxes;

std::vector<Pair> exact(const FatBoxes& fat, Span<const Aabb> boxes) {
  std::vector<Pair> pairs;
  for (const Pair pair : fat.candidates())
    if (overlaps(boxes[pair.a], boxes[pair.b])) pairs.push_back(pair);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

class EachRoom : public testing::TestWithParam<double> {};

TEST_P(EachRoom, HasAllPairsOfEachFrame) {
  FatBoxes fat(GetParam());
  MovingBoxes moving(batches::make("D", 300, 1), Brownian{0.7, 0.02}, 1);
  fat.start(moving.boxes());
  for (int frame = 0; frame < 30; ++frame) {
    ASSERT_EQ(exact(fat, moving.boxes()), all_against_all(moving.boxes())) << "frame " << frame;
    moving.next_frame();
    fat.next_frame(moving.boxes(), moving.moved());
  }
}

INSTANTIATE_TEST_SUITE_P(Rooms, EachRoom, testing::Values(0.0, 0.001, 0.05, 0.5));

TEST(FatBoxes, WithoutRoomHasNoExtraPairs) {
  FatBoxes fat(0);
  MovingBoxes moving(batches::make("D", 300, 1), Brownian{1, 0.1}, 1);
  fat.start(moving.boxes());
  for (int frame = 0; frame < 5; ++frame) {
    moving.next_frame();
    EXPECT_EQ(fat.next_frame(moving.boxes(), moving.moved()), 300u);
    ASSERT_EQ(fat.candidates().size(), all_against_all(moving.boxes()).size());
  }
}

TEST(FatBoxes, CountsThoseThatLeaveTheirRoom) {
  std::vector<Aabb> boxes{{{0, 0, 0}, {1, 1, 1}}, {{1.25F, 0, 0}, {2.25F, 1, 1}}};
  const std::vector<std::uint32_t> first{0};
  FatBoxes fat(0.25);
  fat.start(boxes);
  EXPECT_EQ(fat.candidates().size(), 1u) << "rooms touch, boxes do not";
  const auto place = [&](float x) {
    boxes[0].min[0] = x;
    boxes[0].max[0] = x + 1;
    return fat.next_frame(boxes, first);
  };
  EXPECT_EQ(place(0.25F), 0u) << "up to the end of its room";
  EXPECT_EQ(place(-0.5F), 1u);
  EXPECT_EQ(fat.candidates().size(), 0u);
  EXPECT_EQ(place(-0.625F), 0u) << "the room is a new one";
}

TEST(FatBoxes, StartsAfresh) {
  FatBoxes fat(0.1);
  const std::vector<Aabb> many = batches::make("D", 100, 1), few = batches::make("D", 50, 2);
  fat.start(many);
  fat.start(few);
  EXPECT_EQ(exact(fat, few), all_against_all(Span<const Aabb>(few)));
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
