// SPDX-License-Identifier: MIT
#include "pictures/viewer/snapshot.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace boxstream::view {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

void add(Snapshot& snapshot, Mood mood, float min, float max) {
  snapshot.moods.push_back(mood);
  snapshot.boxes.push_back({{min, min, min}, {max, max, max}});
}

TEST(Crowd, LeavesStraysAndSceneryOut) {
  Snapshot snapshot;
  for (int i = 0; i < 300; ++i) add(snapshot, Mood::moving, static_cast<float>(i % 10), static_cast<float>(i % 10 + 1));
  add(snapshot, Mood::moving, 5000, 5001);
  add(snapshot, Mood::moving, -7000, -6999);
  add(snapshot, Mood::fixed, -100, 100);
  add(snapshot, Mood::gone, 1, -1);
  add(snapshot, Mood::moving, -infinity, infinity);
  const Snapshot::Box crowd = crowd_of(snapshot);
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_EQ(crowd.min[d], 0);
    EXPECT_EQ(crowd.max[d], 10);
  }
}

TEST(Crowd, FewBodiesHaveNoStrays) {
  Snapshot snapshot;
  add(snapshot, Mood::moving, 0, 1);
  add(snapshot, Mood::moving, 50, 51);
  EXPECT_EQ(crowd_of(snapshot).min[0], 0);
  EXPECT_EQ(crowd_of(snapshot).max[0], 51);
}

TEST(Crowd, IsAllThereIsWhereNothingMoves) {
  Snapshot snapshot;
  EXPECT_EQ(crowd_of(snapshot).max[0], 1);
  add(snapshot, Mood::fixed, -3, 4);
  EXPECT_EQ(crowd_of(snapshot).min[0], -3);
  EXPECT_EQ(crowd_of(snapshot).max[0], 4);
}

}  // namespace
}  // namespace boxstream::view
