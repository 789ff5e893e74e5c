// SPDX-License-Identifier: MIT
#include "pictures/viewer/frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "block_reader.hpp"
#include "mixed.hpp"

namespace boxstream::view {
namespace {

using view_test::BlockReader;

constexpr float unit = 1.0F / 1024;

/// Whole units; what has no end is cut off far away.
std::int32_t in_units(float length) {
  return static_cast<std::int32_t>(std::clamp(std::round(length / unit), -0x1p30F, 0x1p30F));
}

void expect_same(const Snapshot& given, const BlockReader::Frame& read, std::size_t frame) {
  for (std::size_t i = 0; i < given.poses.size(); ++i) {
    for (std::size_t d = 0; d < 3; ++d) {
      const std::int32_t place = read.places[3 * i + d];
      ASSERT_EQ(place, in_units(given.poses[i].position[d])) << "frame " << frame << " object " << i;
      ASSERT_EQ(place + read.corners[6 * i + d], in_units(given.boxes[i].min[d]))
          << "frame " << frame << " object " << i;
      ASSERT_EQ(place + read.corners[6 * i + 3 + d], in_units(given.boxes[i].max[d]))
          << "frame " << frame << " object " << i;
    }
    for (std::size_t d = 0; d < 4; ++d)
      ASSERT_NEAR(static_cast<float>(read.rotations[4 * i + d]) * FrameEncoder::rotation_unit,
                  given.poses[i].rotation[d], 0.51F * FrameEncoder::rotation_unit);
    ASSERT_EQ(read.moods[i], static_cast<std::int32_t>(given.moods[i]));
  }
  for (std::size_t i = 0; i < given.nodes.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d)
      ASSERT_EQ(read.places[3 * (given.poses.size() + i) + d], in_units(given.nodes[i][d]));
  ASSERT_EQ(read.islands, given.islands);
  ASSERT_EQ(read.pairs, given.pairs);
}

TEST(Frames, ARunComesBackFromItsBlocks) {
  scenes::Simulation simulation(view_test::mixed_scene(), "boxstream");
  const Model model = model_of(simulation);
  Snapshot snapshot;
  FrameEncoder encoder(unit);
  std::vector<Snapshot> given;
  std::vector<std::string> blocks;
  for (int step = 0; step < 40; ++step) {
    snapshot.read(simulation, model);
    given.push_back(snapshot);
    encoder.add(snapshot);
    if (encoder.is_full()) blocks.push_back(encoder.take_block());
    simulation.step();
  }
  blocks.push_back(encoder.take_block());
  ASSERT_TRUE(encoder.is_empty());
  ASSERT_EQ(blocks.size(), (given.size() + FrameEncoder::frames_in_block - 1) / FrameEncoder::frames_in_block);
  ASSERT_TRUE(std::any_of(given.begin(), given.end(), [](const Snapshot& s) { return s.pairs.size() > 50; }));

  std::size_t frame = 0;
  for (const std::string& block : blocks) {
    BlockReader reader(block, given[0].poses.size(), given[0].nodes.size());
    for (; !reader.is_at_end(); ++frame) expect_same(given.at(frame), reader.next(), frame);
  }
  EXPECT_EQ(frame, given.size());
}

Snapshot one_body(float x) {
  Snapshot snapshot;
  snapshot.poses = {{{x, 0, 0}, no_rotation}};
  snapshot.moods = {Mood::moving};
  snapshot.islands = {0};
  snapshot.boxes = {{{x, 0, 0}, {x, 0, 0}}};
  return snapshot;
}

TEST(Frames, WhatIsTooFarOrNoNumberIsMarked) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  FrameEncoder encoder(unit);
  // Leaps from end to end overflow every difference on the way.
  for (const float x : {1.0F, nan, 1e30F, -infinity, 2.0F, infinity, nan, 3.0F}) encoder.add(one_body(x));
  const std::string block = encoder.take_block();
  BlockReader reader(block, 1, 0);
  constexpr std::int32_t far_away = 1 << 30;
  for (const std::int32_t expected :
       {1024, FrameEncoder::not_a_number, far_away, -far_away, 2048, far_away, FrameEncoder::not_a_number, 3072})
    EXPECT_EQ(reader.next().places[0], expected);
  EXPECT_TRUE(reader.is_at_end());
}

}  // namespace
}  // namespace boxstream::view
