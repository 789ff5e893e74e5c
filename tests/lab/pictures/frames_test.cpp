// SPDX-License-Identifier: MIT
#include "pictures/viewer/frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "block_reader.hpp"
#include "mixed.hpp"

namespace boxstream::view {
namespace {

using view_test::BlockReader;

constexpr float unit = 1.0F / 1024;
constexpr double rounding = 0.04;  // to sixteenths of a quantum, which comes before

/// What has no end is cut off far away.
double in_units(float length) {
  return std::clamp(static_cast<double>(length / unit), -0x1p25, 0x1p25);
}

void expect_places(const Snapshot& given, const BlockReader::Frame& read) {
  const std::size_t objects = given.poses.size();
  for (std::size_t i = 0; i < read.places.size(); ++i) {
    const Point& place = i / 3 < objects ? given.poses[i / 3].position : given.nodes[i / 3 - objects];
    ASSERT_NEAR(read.places[i], in_units(place[i % 3]), 0.5 + rounding) << "object " << i / 3;
  }
}

void expect_rotations(const Snapshot& given, const std::vector<std::uint32_t>& turning,
                      const BlockReader::Frame& read) {
  ASSERT_EQ(read.rotations.size(), 4 * turning.size());
  for (std::size_t i = 0; i < read.rotations.size(); ++i)
    ASSERT_NEAR(read.rotations[i] * double{FrameEncoder::rotation_unit}, given.poses[turning[i / 4]].rotation[i % 4],
                (0.5 + rounding) * double{FrameEncoder::rotation_unit});
}

/// `former` is where things are in the frame before.
void expect_boxes(const Snapshot& given, const std::vector<double>& former, const BlockReader::Frame& read) {
  for (std::size_t i = 0; i < given.boxes.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      const double middle = former[3 * i + d] + 2 * read.boxes[6 * i + d], half = read.boxes[6 * i + 3 + d];
      if (given.boxes[i].min[d] > given.boxes[i].max[d]) {
        ASSERT_TRUE(std::isnan(half)) << "object " << i;
        continue;
      }
      ASSERT_NEAR(middle - half, in_units(given.boxes[i].min[d]), 2 + 4 * rounding) << "object " << i;
      ASSERT_NEAR(middle + half, in_units(given.boxes[i].max[d]), 2 + 4 * rounding) << "object " << i;
    }
}

void expect_pairs(const Snapshot& given, const BlockReader::Frame& read) {
  ASSERT_EQ(read.pairs, given.pairs);
  std::set<Pair> touching;
  for (const Contact& contact : given.contacts) touching.insert(contact.objects);
  for (std::size_t i = 0; i < read.pairs.size(); ++i)
    ASSERT_EQ(read.touching[i], touching.contains(read.pairs[i])) << read.pairs[i].a << ' ' << read.pairs[i].b;
}

Point direction(const std::array<std::uint32_t, 2>& digits) {
  double x = 2 * digits[0] / 63.0 - 1, y = 2 * digits[1] / 63.0 - 1;
  const double z = 1 - std::fabs(x) - std::fabs(y);
  if (z < 0) {
    const double folded = std::copysign(1 - std::fabs(y), x);
    y = std::copysign(1 - std::fabs(x), y);
    x = folded;
  }
  const double length = std::hypot(x, y, z);
  return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

void expect_contacts(const Snapshot& given, const std::vector<double>& former, const BlockReader::Frame& read) {
  ASSERT_TRUE(read.contacts) << "there are few";
  ASSERT_EQ(read.contacts->size(), given.contacts.size());
  for (std::size_t i = 0; i < given.contacts.size(); ++i) {
    const BlockReader::Contact& contact = (*read.contacts)[i];
    ASSERT_EQ(contact.objects, given.contacts[i].objects);
    const std::uint32_t from = given.moods[contact.objects.a] == Mood::fixed ? contact.objects.b : contact.objects.a;
    double along = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double place = former[3 * from + d] + static_cast<double>(4 * contact.place[d]);
      ASSERT_NEAR(place, in_units(given.contacts[i].place[d]), 2 + 4 * rounding);
      along += double{direction(contact.normal)[d]} * double{given.contacts[i].normal[d]};
    }
    ASSERT_GT(along, std::cos(0.07)) << "the normal";
  }
}

TEST(Frames, ARunComesBackFromItsBlocks) {
  scenes::Simulation simulation(view_test::mixed_scene(), "boxstream");
  const Model model = model_of(simulation);
  Snapshot snapshot;
  FrameEncoder encoder(unit, model);
  std::vector<Snapshot> given;
  std::vector<std::string> blocks;
  for (int step = 0; step < 150; ++step) {
    snapshot.read(simulation, model);
    snapshot.read_contacts(simulation, model);
    given.push_back(snapshot);
    encoder.add(snapshot);
    if (encoder.is_full()) blocks.push_back(encoder.take_block());
    simulation.step();
  }
  blocks.push_back(encoder.take_block());
  ASSERT_TRUE(encoder.is_empty());
  ASSERT_EQ(blocks.size(), (given.size() + FrameEncoder::frames_in_block - 1) / FrameEncoder::frames_in_block);
  ASSERT_TRUE(std::any_of(given.begin(), given.end(), [](const Snapshot& s) { return s.contacts.size() > 50; }));

  const std::vector<std::uint32_t> turns = turning(model);
  EXPECT_LT(turns.size(), model.states.size()) << "balls are not among them";
  std::size_t frame = 0;
  for (const std::string& block : blocks) {
    BlockReader reader(block, given[0].poses.size(), given[0].nodes.size(), turns.size());
    std::vector<double> former;
    for (; !reader.is_at_end(); ++frame) {
      SCOPED_TRACE(testing::Message() << "frame " << frame);
      const Snapshot& expected = given.at(frame);
      const BlockReader::Frame read = reader.next();
      if (former.empty()) former = read.places;
      expect_places(expected, read);
      expect_rotations(expected, turns, read);
      expect_boxes(expected, former, read);
      for (std::size_t i = 0; i < expected.moods.size(); ++i) {
        ASSERT_EQ(read.islands[i], expected.islands[i]);
        ASSERT_EQ(read.moods[i], static_cast<double>(expected.moods[i]));
      }
      expect_pairs(expected, read);
      expect_contacts(expected, former, read);
      if (testing::Test::HasFatalFailure()) return;
      former = read.places;
    }
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

Model one_ball() {
  Model model;
  model.forms.resize(1);
  model.forms[0].kind = scenes::Drawable::Kind::sphere;
  model.parts.resize(1);
  model.states.resize(1);
  return model;
}

TEST(Frames, WhatIsTooFarOrNoNumberIsMarked) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  FrameEncoder encoder(unit, one_ball());
  for (const float x : {1.0F, nan, 1e30F, -infinity, 2.0F, infinity, nan, nan, 3.0F}) encoder.add(one_body(x));
  const std::string block = encoder.take_block();
  BlockReader reader(block, 1, 0, 0);
  constexpr double far_away = 1 << 25;
  for (const double expected :
       {1024.0, double{nan}, far_away, -far_away, 2048.0, far_away, double{nan}, double{nan}, 3072.0}) {
    const double read = reader.next().places[0];
    if (std::isnan(expected))
      EXPECT_TRUE(std::isnan(read)) << read;
    else
      EXPECT_EQ(read, expected);
  }
  EXPECT_TRUE(reader.is_at_end());
}

TEST(Frames, WhatRestsOrFliesOnCostsNothing) {
  FrameEncoder encoder(unit, one_ball());
  const auto add = [&](int frame) { encoder.add(one_body(10 + 0.01F * static_cast<float>(frame))); };
  for (int frame = 0; frame < 20; ++frame) add(frame);
  const std::string start = encoder.take_block();
  for (int frame = 0; frame < 40; ++frame) add(frame);
  const std::string all = encoder.take_block();
  for (std::size_t i = start.size(); i < all.size(); ++i) EXPECT_LE(all[i], 2) << "byte " << i;
}

}  // namespace
}  // namespace boxstream::view
