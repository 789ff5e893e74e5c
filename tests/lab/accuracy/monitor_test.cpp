// SPDX-License-Identifier: MIT
// Measures of small worlds that have a closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy/sweep.hpp"

namespace boxstream::accuracy_test {
namespace {

using namespace accuracy;
using nlohmann::json;

json scene_of(const std::string& bodies, const json& gravity, double dt, int steps) {
  json scene = json::parse(R"({"format": 1, "meta": {"name": "made", "about": "made", "source": "closed form"},
    "world": {"bounds": {"min": [-9, -9, -9], "max": [9, 9, 9]}}, "shapes": [
      {"name": "ball", "type": "sphere", "radius": 0.5}, {"name": "brick", "type": "box", "half_extents": [1, 2, 3]},
      {"name": "floor", "type": "box", "half_extents": [5, 1, 5]}]})");
  scene["time"] = {{"dt", dt}, {"steps", steps}};
  scene["world"]["gravity"] = gravity;
  scene["bodies"] = json::parse(bodies);
  return scene;
}

Request request_of(const json& scene, const std::vector<std::string>& measures, const std::string& knob = "erp=0.2") {
  Request request;
  request.file = "made.json";
  request.scene = scene;
  request.knobs.push_back(parse_knob(knob));
  for (const std::string& measure : measures) request.measures.push_back(parse_measure(measure));
  request.repeats = 1;
  return request;
}

std::vector<Row> rows_of(const Request& request) {
  return run(request, [](const Stage&) {}).rows;
}

TEST(Monitor, AngularMomentumOfABodyWithoutItsGyroscopicTerm) {
  // It keeps turning about one axis n, so L goes round n: after half a turn by twice its part across n.
  const double speed = std::numbers::pi / 32 * 64;  // half a turn in 32 steps of 1/64 s
  const double c = 0.6, s = 0.8;
  json scene = scene_of(R"([{"shape": "brick", "mass": 3, "position": [0, 0, 0], "gyro": false, "sleep": false}])",
                        {0, 0, 0}, 1.0 / 64, 40);
  scene["bodies"][0]["spin"] = {speed * c, 0, speed * s};
  const double x = 13, z = 5;  // moments of inertia: mass / 3 times the sums of squares
  const double expected = 2 * (x - z) * s * c / std::hypot(x * c, z * s);
  const Row row = rows_of(request_of(scene, {"angular_momentum_drift", "energy_drift"})).at(0);
  EXPECT_NEAR(row.series[0].worst, expected, 1e-4);
  EXPECT_LT(row.series[1].worst, 1e-5);
}

TEST(Monitor, AngularMomentumOfAPairThatPassesIsKept) {
  // Without a force each keeps x * v, however far it goes.
  const json scene = scene_of(R"([{"shape": "ball", "mass": 2, "position": [-3, 1, 0], "velocity": [2, 0, 0]},
    {"shape": "ball", "mass": 1, "position": [3, -2, 0], "velocity": [-1, 0, 0.5]}])",
                              {0, 0, 0}, 1.0 / 64, 64);
  const Row row = rows_of(request_of(scene, {"angular_momentum_drift", "momentum_drift"})).at(0);
  EXPECT_LT(row.series[0].worst, 1e-6);
  EXPECT_LT(row.series[1].worst, 1e-7);
}

TEST(Monitor, MomentumChangesByTheImpulseOfGravity) {
  const json scene = scene_of(R"([{"shape": "ball", "mass": 2, "position": [0, 0, 0], "velocity": [4, 0, 0]}])",
                              {0, -8, 0}, 1.0 / 64, 32);
  EXPECT_NEAR(rows_of(request_of(scene, {"momentum_drift"})).at(0).series[0].last, 1, 1e-6);
}

TEST(Monitor, DriftOfAFewGramsIsAShareOfTheirEnergy) {
  // Over its lowest point it has 0.002 * 8 * 0.5 J. A fall in steps of h ends with m g^2 t h / 2 too little.
  const json scene = scene_of(R"([{"shape": "ball", "mass": 0.002, "position": [0, 0, 0]}])", {0, -8, 0}, 1.0 / 64, 16);
  const Row row = rows_of(request_of(scene, {"energy_drift", "energy_change.last"})).at(0);
  const double share = 8 * 0.25 / 64 / 2 / 0.5;
  EXPECT_NEAR(row.series[0].worst, share, 1e-5);
  EXPECT_NEAR(row.series[1].last, -share, 1e-5);
}

TEST(Monitor, EnergyOfSpringsIsNoDrift) {
  json scene = scene_of(R"([{"name": "b", "shape": "ball", "mass": 2, "position": [0, 0, 0], "velocity": [0, 3, 0],
    "sleep": false}])",
                        {0, 0, 0}, 1.0 / 128, 256);
  scene["joints"] = json::parse(R"([{"type": "spring", "a": "b", "pivot": [0, 0, 0], "stiffness": 50, "damping": 0}])");
  const Row row = rows_of(request_of(scene, {"energy_drift"})).at(0);
  // 5 rad/s: places and speeds of steps of h are half a step apart.
  EXPECT_NEAR(row.series[0].worst, 5.0 / 128 / 2, 5e-4);
}

TEST(Monitor, HeightLossOfAFallAndWhenItIsATenth) {
  // The top is 3.5 m over the lowest point; h = 1/64 s, 8 n (n + 1) / 2 h^2 fallen after n steps.
  const json scene = scene_of(R"([{"shape": "ball", "mass": 1, "position": [0, 0, 0]},
    {"shape": "ball", "mass": 1, "position": [3, 2.5, 0]}])",
                              {0, -8, 0}, 1.0 / 64, 40);
  const Row row = rows_of(request_of(scene, {"height_loss", "collapse_time", "stands"})).at(0);
  const auto loss = [](int n) { return 4.0 * n * (n + 1) / 64 / 64 / 3.5; };
  EXPECT_NEAR(row.series[0].last, loss(40), 1e-5);
  int fallen = 1;
  while (loss(fallen) <= 0.1) ++fallen;
  EXPECT_NEAR(row.series[1].last, fallen / 64.0, 1e-12);
  EXPECT_EQ(row.series[2].last, 0);
  json still = scene;
  still["world"]["gravity"] = {0, 0, 0};
  const Row standing = rows_of(request_of(still, {"collapse_time", "stands"})).at(0);
  EXPECT_NEAR(standing.series[0].last, 40 / 64.0, 1e-12);
  EXPECT_EQ(standing.series[1].last, 1);
}

TEST(Monitor, HeightIsMeasuredAgainstGravity) {
  // Along z both fall by 6 n (n + 1) / 2 h^2, from a height of 4 m. Along y their extent grows.
  json scene = scene_of(R"([{"shape": "ball", "mass": 1, "position": [0, 0, 0], "velocity": [0, 6, 0]},
    {"shape": "ball", "mass": 1, "position": [3, 0, 3]}])",
                        {0, 0, -6}, 1.0 / 64, 32);
  const auto fallen = [](int n) { return 3.0 * n * (n + 1) / 64 / 64; };
  const Row row = rows_of(request_of(scene, {"height_loss", "stands"})).at(0);
  EXPECT_NEAR(row.series[0].worst, fallen(32) / 4, 1e-5);
  EXPECT_EQ(row.series[1].last, 0);
  // The same fall aslant, by 3 to 4 to the axes.
  scene["world"]["gravity"] = {0, -3.6, -4.8};
  scene["bodies"][0]["velocity"] = {0, 0, 0};
  scene["bodies"][1]["position"] = {3, 1.8, 2.4};
  EXPECT_NEAR(rows_of(request_of(scene, {"height_loss"})).at(0).series[0].last, fallen(32) / 4, 1e-5);
}

TEST(Monitor, PenetrationThatNothingMends) {
  json scene = scene_of(R"([{"shape": "floor", "type": "static", "position": [0, -1, 0]},
    {"shape": "ball", "mass": 1, "position": [0, 0.375, 0], "sleep": false}])",
                        {0, 0, 0}, 1.0 / 64, 32);
  scene["solver"]["contact_erp"] = 0;
  const Row row = rows_of(request_of(scene, {"mean_square_penetration", "penetration", "penetration.integral"})).at(0);
  EXPECT_NEAR(row.series[0].worst, 0.125 * 0.125, 1e-6);
  EXPECT_NEAR(row.series[1].p95, 0.125, 1e-6);
  EXPECT_NEAR(row.series[2].integral, 0.125 * 0.5, 1e-6);
  scene["solver"]["contact_erp"] = 0.5;
  scene["solver"]["split_impulse"] = false;
  // A step pushes it out at half the depth a step, and nothing stops it then.
  EXPECT_NEAR(rows_of(request_of(scene, {"max_speed"})).at(0).series[0].last, 0.0625 * 64, 1e-3);
}

TEST(Monitor, TunnelledIsTheShareOutOfBounds) {
  const json scene = scene_of(R"([{"shape": "ball", "mass": 1, "position": [0, 0, 0], "velocity": [0, 0, 20]},
    {"shape": "ball", "mass": 1, "position": [3, 0, 0]}, {"shape": "ball", "mass": 1, "position": [-3, 0, 0]},
    {"shape": "ball", "mass": 1, "position": [6, 0, 0]}])",
                              {0, 0, 0}, 1.0 / 64, 64);
  const Series tunnelled = rows_of(request_of(scene, {"tunnelled"})).at(0).series[0];
  EXPECT_EQ(tunnelled.last, 0.25);
  // Beyond 9 m after 29 steps of 0.3125 m.
  EXPECT_NEAR(tunnelled.mean, 0.25 * (64 - 28) / 64, 1e-12);
}

TEST(Monitor, TunnelledIsAShareOfAllThatTheSceneHas) {
  json scene = scene_of(R"([{"shape": "ball", "mass": 1, "position": [0, 0, 0], "velocity": [0, 0, 20]},
    {"shape": "ball", "mass": 1, "position": [3, 0, 0], "velocity": [0, 0, -20]},
    {"shape": "ball", "mass": 1, "position": [-3, 0, 0]}, {"shape": "ball", "mass": 1, "position": [6, 0, 0]},
    {"shape": "ball", "mass": 1, "position": [-6, 0, 0]}])",
                        {0, 0, 0}, 1.0 / 64, 32);
  scene["world"]["on_leave"] = "remove";
  EXPECT_EQ(rows_of(request_of(scene, {"tunnelled"})).at(0).series[0].last, 0.4) << "of 5, though 3 are left";
  for (json& body : scene["bodies"]) body["velocity"] = {0, 0, 20};
  EXPECT_EQ(rows_of(request_of(scene, {"tunnelled"})).at(0).series[0].last, 1);
}

TEST(Monitor, BallsThatJumpOverAPlateTunnel) {
  json scene = scene_of("[]", {0, 0, 0}, 1.0 / 64, 20);
  scene["shapes"].push_back(json::parse(R"({"name": "plate", "type": "box", "half_extents": [9, 0.0625, 9]})"));
  scene["shapes"][0]["radius"] = 0.25;
  scene["world"]["bounds"]["min"] = {-9, 0, -9};
  // A metre a step: every other ball ends a step half a metre above the plate and the next half a metre below it, and
  // never touches it; the others end one 1/8 m above its middle.
  for (int i = 0; i < 8; ++i) {
    json ball = json::parse(R"({"shape": "ball", "mass": 1, "velocity": [0, -64, 0], "sleep": false, "ccd": false})");
    ball["position"] = {2 * i - 7, i % 2 == 0 ? 4.5 : 4.125, 0};
    scene["bodies"].push_back(ball);
  }
  scene["bodies"].push_back(json::parse(R"({"shape": "plate", "type": "static", "position": [0, 0, 0]})"));
  EXPECT_EQ(rows_of(request_of(scene, {"tunnelled"})).at(0).series[0].last, 0.5);
  for (int i = 0; i < 8; ++i) scene["bodies"][i]["ccd"] = {{"threshold", 0.25}, {"radius", 0.125}};
  EXPECT_EQ(rows_of(request_of(scene, {"tunnelled"})).at(0).series[0].last, 0);
}

TEST(Monitor, VelocityBesideAClosedForm) {
  const json scene = scene_of(R"([{"shape": "ball", "mass": 1, "position": [0, 0, 0], "velocity": [3, 0, 0]}])",
                              {0, -8, 0}, 1.0 / 64, 32);
  Request request = request_of(scene, {"velocity_error", "direction_error"});
  request.expected = Expected{0, {3, -4, 0}};
  const Row right = rows_of(request).at(0);
  EXPECT_LT(right.series[0].last, 1e-6);
  EXPECT_LT(right.series[1].last, 1e-4);
  request.expected = Expected{0, {4, 3, 0}};
  const Row wrong = rows_of(request).at(0);
  EXPECT_NEAR(wrong.series[0].last, std::sqrt(50) / 5, 1e-6);
  EXPECT_NEAR(wrong.series[1].last, 90, 1e-4);
}

TEST(Monitor, ExplosionIsAFailure) {
  json scene = scene_of(R"([{"shape": "floor", "type": "static", "position": [0, -1, 0]},
    {"shape": "ball", "mass": 1, "position": [0, 0.25, 0], "sleep": false}])",
                        {0, -0.001, 0}, 1.0 / 64, 8);
  scene["solver"]["split_impulse"] = false;
  // Falls of 31 m at most: 0.25 m/s; half of 0.25 m in a step of 1/64 s: 8 m/s.
  const std::vector<Row> rows = rows_of(request_of(scene, {"max_speed"}, "contact_erp=0.5,0"));
  EXPECT_NE(rows[0].failure.find("exploded in step 1"), std::string::npos) << rows[0].failure;
  EXPECT_EQ(rows[1].failure, "");
}

TEST(Monitor, GapsAreThoseOfTheJointThatIsNamed) {
  // One ball swings fast about its joint, which gives way; the other is at rest.
  json scene = scene_of(R"([{"name": "calm", "shape": "ball", "mass": 1, "position": [-3, 0, 0]},
    {"name": "wild", "shape": "ball", "mass": 1, "position": [3, 0, 0], "velocity": [0, 20, 0]}])",
                        {0, 0, 0}, 1.0 / 64, 16);
  scene["joints"] = json::parse(R"([{"type": "ball", "a": "calm", "pivot": [-2, 0, 0]},
    {"type": "ball", "a": "wild", "pivot": [4, 0, 0]}])");
  Request request = request_of(scene, {"joint_error"});
  const auto gap = [&](const std::string& joint) {
    request.joint_name = joint;
    return rows_of(request).at(0).series[0].worst;
  };
  EXPECT_EQ(gap("calm"), 0);
  EXPECT_GT(gap("wild"), 0);
  EXPECT_EQ(gap("1"), gap("wild,world"));
  EXPECT_EQ(gap("1"), gap(""));
  EXPECT_THROW(gap("2"), BadKnob);
  EXPECT_THROW(gap("world"), BadKnob) << "there are two";
}

TEST(Monitor, WhatWindBlowsAwayDoesNotExplode) {
  json scene = scene_of(R"([{"shape": "ball", "mass": 1, "position": [0, 0, 0], "velocity": [0.1, 0, 0]}])", {0, 0, 0},
                        1.0 / 64, 128);
  scene["fields"] = json::parse(R"([{"type": "wind", "velocity": [8, 0, 0]}])");
  const Row row = rows_of(request_of(scene, {"max_speed.last"})).at(0);
  EXPECT_EQ(row.failure, "");
  EXPECT_GT(row.series[0].last, 1) << "ten times as fast as at the start";
}

TEST(Monitor, WhatABatHitsDoesNotExplode) {
  // It parts from the bat as fast as they met, 1.52 m/s on top of the bat's 1.5 m/s: more than ten times its own speed.
  json scene = scene_of(R"([{"shape": "ball", "mass": 1, "position": [0.25, 0, 0], "velocity": [-0.02, 0, 0],
      "material": "steel", "sleep": false},
    {"shape": "floor", "type": "kinematic", "position": [-5.5, 0, 0], "velocity": [1.5, 0, 0], "material": "steel"}])",
                        {0, 0, 0}, 1.0 / 64, 48);
  scene["materials"] = json::parse(R"({"steel": {"friction": 0, "restitution": 1}})");
  scene["solver"]["bounces"] = "on_contact";
  const Row row = rows_of(request_of(scene, {"max_speed.last"})).at(0);
  EXPECT_EQ(row.failure, "");
  EXPECT_NEAR(row.series[0].last, 2 * 1.5 + 0.02, 1e-3);
}

TEST(Monitor, WhatAMotorDrivesDoesNotExplode) {
  json scene =
      scene_of(R"([{"name": "arm", "shape": "ball", "mass": 1, "position": [2, 0, 0]}])", {0, 0, 0}, 1.0 / 64, 64);
  scene["bodies"][0]["velocity"] = {0, 0.001, 0};
  scene["joints"] = json::parse(R"([{"type": "hinge", "a": "arm", "pivot": [0, 0, 0], "axis": [0, 0, 1],
    "motor": {"speed": 1, "max_force": 100}}])");
  const Row row = rows_of(request_of(scene, {"max_speed.last"})).at(0);
  EXPECT_EQ(row.failure, "");
  EXPECT_NEAR(row.series[0].last, 2, 0.01) << "1 rad/s, 2 m from its hinge";
}

TEST(Monitor, SecondRunEndsWithTheSameBits) {
  const json scene = scene_of(R"([{"shape": "floor", "type": "static", "position": [0, -1, 0]},
    {"shape": "brick", "mass": 1, "position": [0, 4, 0], "spin": [1, 2, 3]}])",
                              {0, -8, 0}, 1.0 / 64, 64);
  EXPECT_EQ(rows_of(request_of(scene, {"repeatable", "joint_error"})).at(0).series[0].last, 1);
  EXPECT_TRUE(std::isnan(rows_of(request_of(scene, {"joint_error"})).at(0).series[0].last)) << "no joint";
}

}  // namespace
}  // namespace boxstream::accuracy_test
