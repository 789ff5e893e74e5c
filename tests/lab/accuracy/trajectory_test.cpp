// SPDX-License-Identifier: MIT
#include "accuracy/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy/sweep.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::accuracy_test {
namespace {

using namespace accuracy;

TEST(Trajectory, DistanceAndAngleAreRootMeanSquares) {
  const btScalar quarter = static_cast<btScalar>(std::numbers::pi / 2);
  const btQuaternion still = btQuaternion::getIdentity(), turned(btVector3(0, 0, 1), quarter);
  const Frame a{{{0, 0, 0}, {1, 0, 0}}, {still, still}}, b{{{0, 3, 0}, {1, 0, 4}}, {turned, -still}};
  EXPECT_NEAR(distance(a, b), std::sqrt((9 + 16) / 2.0), 1e-6);
  // The same rotation has two quaternions.
  EXPECT_NEAR(angle(a, b), 90 / std::sqrt(2), 1e-4);
}

TEST(Trajectory, SmallAnglesKeepTheirDigits) {
  const btScalar small = btScalar(1e-4);
  const Frame a{{{0, 0, 0}}, {btQuaternion::getIdentity()}}, b{{{0, 0, 0}}, {btQuaternion(btVector3(0, 1, 0), small)}};
  EXPECT_NEAR(angle(a, b), 1e-4 * 180 / std::numbers::pi, 1e-7);
}

TEST(Trajectory, PartsWhereOneTouchesAndTheOtherDoesNot) {
  Trajectory a, b;
  a.contacts = {{{0, 1}, 1.0}, {{0, 2}, 2.0}};
  b.contacts = {{{0, 1}, 1.05}, {{0, 2}, 2.0}};
  EXPECT_EQ(divergence_time(a, b, 0.1, 5), 5);
  EXPECT_EQ(divergence_time(a, b, 0.01, 5), 1);
  b.contacts[{1, 2}] = 3;
  EXPECT_EQ(divergence_time(a, b, 0.1, 5), 3);
  // Too close to the end to tell.
  EXPECT_EQ(divergence_time(a, b, 0.1, 3.05), 3.05);
}

/// Two balls at 3 m/s, the first of which is frozen where it leaves, beyond 5 m.
const char* const one_freezes = R"({"format": 1, "meta": {"name": "made", "about": "made", "source": "made"},
  "time": {"dt": 0.0625, "steps": 32},
  "world": {"gravity": [0, 0, 0], "on_leave": "freeze", "bounds": {"min": [-9, -9, -9], "max": [5, 9, 9]}},
  "shapes": [{"name": "ball", "type": "sphere", "radius": 0.25}],
  "bodies": [{"shape": "ball", "mass": 1, "position": [2, 4, 0], "velocity": [3, 0, 0], "sleep": false},
    {"shape": "ball", "mass": 1, "position": [-8, 0, 0], "velocity": [3, 0, 0], "sleep": false}]})";

TEST(Trajectory, WhatIsFrozenStaysInItsPlaceOfFrames) {
  scenes::Simulation simulation(scenes::parse_scene(one_freezes, "made.json"), "boxstream");
  const Frame first = frame_of(simulation);
  while (simulation.steps_done() < 32) simulation.advance();
  const Frame last = frame_of(simulation);
  ASSERT_EQ(last.positions.size(), 2U);
  // Steps of 0.1875 m: the first ball is beyond 5 m after 17 of them.
  EXPECT_NEAR(last.positions[0].x(), 2 + 17 * 0.1875, 1e-5);
  EXPECT_NEAR(last.positions[1].x(), -8 + 32 * 0.1875, 1e-5);
  EXPECT_NEAR(distance(first, last), std::sqrt((std::pow(17 * 0.1875, 2) + std::pow(32 * 0.1875, 2)) / 2), 1e-5);
  EXPECT_NEAR(size_of_bodies(simulation), 0.5, 1e-6);
}

/// Whole steps fall by 4 t (t + 1/16 s), fine ones by less: the reference freezes a step later.
TEST(Trajectory, FrozenBodiesAreComparedWithThemselves) {
  Request request;
  request.file = "made.json";
  request.scene = nlohmann::json::parse(one_freezes);
  request.scene["time"]["steps"] = 18;
  request.scene["world"]["gravity"] = {0, -8, 0};
  request.scene["world"]["bounds"]["min"] = {-9, -4.1, -9};
  request.scene["bodies"][0]["position"] = {2, 0, 0};
  request.scene["bodies"][1]["position"] = {-8, 8, 0};
  for (nlohmann::json& body : request.scene["bodies"]) body["velocity"] = {0, 0, 0};
  request.knobs.push_back(parse_knob("substeps=1"));
  request.measures.push_back(parse_measure("trajectory"));
  request.repeats = 1;
  const Row row = run(request, [](const Stage&) {}).rows.at(0);
  EXPECT_EQ(row.failure, "");
  // Neither is ever farther off than what falls for 18 steps.
  EXPECT_GT(row.series[0].worst, 0.2);
  EXPECT_LT(row.series[0].worst, 4 * 18 / 16.0 / 16);
}

/// Coarse steps jump over a plate that the reference meets.
TEST(Trajectory, TrajectoriesAreComparedAsLongAsContactsAgree) {
  Request request;
  request.file = "made.json";
  request.scene = nlohmann::json::parse(R"({"format": 1, "meta": {"name": "made", "about": "made", "source": "made"},
    "time": {"dt": 0.015625, "steps": 16}, "world": {"gravity": [0, 0, 0], "bounds": {"min": [-9, -99, -9], "max": [9, 9, 9]}},
    "shapes": [{"name": "ball", "type": "sphere", "radius": 0.1}, {"name": "plate", "type": "box", "half_extents": [5, 0.05, 5]}],
    "bodies": [{"shape": "plate", "type": "static", "position": [0, 0, 0]},
      {"shape": "ball", "mass": 1, "position": [0, 4.5, 0], "velocity": [0, -64, 0], "ccd": false, "sleep": false}]})");
  request.knobs.push_back(parse_knob("substeps=1,64"));
  for (const char* name : {"agrees_for", "trajectory_until", "trajectory.last"})
    request.measures.push_back(parse_measure(name));
  request.repeats = 1;
  const std::vector<Row> rows = run(request, [](const Stage&) {}).rows;
  // A metre a step: in the fifth, which begins at 4/64 s, the reference meets the plate.
  EXPECT_NEAR(rows[0].series[0].last, 4 / 64.0, 1e-12);
  EXPECT_LT(rows[0].series[1].worst, 1e-4);
  EXPECT_GT(rows[0].series[2].last, 5);
  EXPECT_EQ(rows[1].series[0].last, 0.25);
  EXPECT_LT(rows[1].series[2].last, 1e-4);
}

}  // namespace
}  // namespace boxstream::accuracy_test
