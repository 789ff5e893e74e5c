// SPDX-License-Identifier: MIT
#include "boxes/methods.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "boxes/inputs.hpp"
#include "boxes/pair_difference.hpp"

namespace boxstream::report {
namespace {

TEST(Methods, AreReadWithTheirSettings) {
  const std::vector<Method> methods = read_methods(R"(["detector", {"way": "rooms", "room": 0.05, "most": 7}])"_json);
  ASSERT_EQ(methods.size(), 2u);
  EXPECT_EQ(methods[0].series, "detector");
  EXPECT_FALSE(methods[0].superset);
  EXPECT_EQ(methods[1].setting, "5 %");
  EXPECT_EQ(methods[1].most, 7u);
  EXPECT_TRUE(methods[1].superset);
}

TEST(Methods, AreRefusedByName) {
  EXPECT_THROW(read_methods(R"(["detektor"])"_json), std::invalid_argument);
  EXPECT_THROW(read_methods(R"([])"_json), std::invalid_argument);
  EXPECT_THROW(read_methods(R"(["rooms"])"_json), nlohmann::json::exception);
}

TEST(Methods, AllAgreeOnBrownianFrames) {
  const Frames frames = brownian("D", 400, 0.5, 0.05, 6);
  for (
      Method& method : read_methods(
          R"(["detector", "world", "dbvt", "cgal:100", {"way": "rooms-tested", "room": 0.1}, {"way": "rooms", "room": 0}])"_json)) {
    std::vector<Pair> pairs;
    method.peer->prepare(frames.boxes.front());
    method.peer->find_pairs(frames.boxes.front(), pairs);
    for (std::size_t frame = 1; frame < frames.boxes.size(); ++frame) {
      method.peer->next_frame(frames.boxes[frame], frames.moved, pairs);
      EXPECT_EQ(compare_pairs(frames.pairs[frame], pairs).complaint(false), "") << method.series << ", frame " << frame;
    }
    method.peer->release();
  }
}

TEST(Methods, TellHowManyPairsANativeHeld) {
  const Frames frames = brownian("D", 400, 1, 0.05, 2);
  std::vector<Method> methods = read_methods(R"(["dbvt", "axis-sweep32", "detector"])"_json);
  for (Method& method : methods) {
    std::vector<Pair> pairs;
    method.peer->prepare(frames.boxes.front());
    method.peer->find_pairs(frames.boxes.front(), pairs);
    EXPECT_EQ(pairs.size(), frames.pairs.front().size());
    if (method.series == "detector")
      EXPECT_EQ(method.peer->candidates(), 0u);
    else
      EXPECT_GE(method.peer->candidates(), pairs.size());
    method.peer->release();
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
