// SPDX-License-Identifier: MIT
#include "boxes/ways.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "boxes/inputs.hpp"
#include "boxes/pair_difference.hpp"

namespace boxstream::report {
namespace {

TEST(Ways, AreReadWithTheirSettings) {
  const std::vector<Way> ways = read_ways(R"(["detector", {"way": "rooms", "room": 0.05, "most": 7}])"_json);
  ASSERT_EQ(ways.size(), 2u);
  EXPECT_EQ(ways[0].series, "detector");
  EXPECT_FALSE(ways[0].superset);
  EXPECT_EQ(ways[1].setting, "5 %");
  EXPECT_EQ(ways[1].most, 7u);
  EXPECT_TRUE(ways[1].superset);
}

TEST(Ways, AreRefusedByName) {
  EXPECT_THROW(read_ways(R"(["detektor"])"_json), std::invalid_argument);
  EXPECT_THROW(read_ways(R"([])"_json), std::invalid_argument);
  EXPECT_THROW(read_ways(R"(["rooms"])"_json), nlohmann::json::exception);
}

TEST(Ways, AllAgreeOnBrownianFrames) {
  const Frames frames = brownian("D", 400, 0.5, 0.05, 6);
  for (
      Way& way : read_ways(
          R"(["detector", "world", "dbvt", "cgal:100", {"way": "rooms-tested", "room": 0.1}, {"way": "rooms", "room": 0}])"_json)) {
    std::vector<Pair> pairs;
    way.peer->prepare(frames.boxes.front());
    way.peer->find_pairs(frames.boxes.front(), pairs);
    for (std::size_t frame = 1; frame < frames.boxes.size(); ++frame) {
      way.peer->next_frame(frames.boxes[frame], frames.moved, pairs);
      EXPECT_EQ(compare_pairs(frames.pairs[frame], pairs).complaint(false), "") << way.series << ", frame " << frame;
    }
    way.peer->release();
  }
}

TEST(Ways, TellHowManyPairsANativeHeld) {
  const Frames frames = brownian("D", 400, 1, 0.05, 2);
  std::vector<Way> ways = read_ways(R"(["dbvt", "axis-sweep32", "detector"])"_json);
  for (Way& way : ways) {
    std::vector<Pair> pairs;
    way.peer->prepare(frames.boxes.front());
    way.peer->find_pairs(frames.boxes.front(), pairs);
    EXPECT_EQ(pairs.size(), frames.pairs.front().size());
    if (way.series == "detector")
      EXPECT_EQ(way.peer->candidates(), 0u);
    else
      EXPECT_GE(way.peer->candidates(), pairs.size());
    way.peer->release();
  }
}

TEST(Bake, FollowsTheBodiesOfAScene) {
  const Frames frames = bake({"demos/scenes/broadmark_fall_cubes.json", 500, 1, 3});
  ASSERT_EQ(frames.boxes.size(), 3u);
  EXPECT_NEAR(static_cast<double>(frames.boxes.front().size()), 500, 50);
  EXPECT_NE(frames.boxes[0].front(), frames.boxes[1].front());
  for (std::size_t frame = 0; frame < 3; ++frame)
    EXPECT_EQ(frames.pairs[frame], all_against_all(Span<const Aabb>(frames.boxes[frame])));
  EXPECT_GE(frames.in_contact, 0);
  EXPECT_LE(frames.in_contact, 1);
}

}  // namespace
}  // namespace boxstream::report
