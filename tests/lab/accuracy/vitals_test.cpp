// SPDX-License-Identifier: MIT
// Runs that are wrong in a way that their own metric does not see.
#include "simulation/run/vitals.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "formats/scene_json/load_scene.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::accuracy_test {
namespace {

using namespace scenes;

Vitals vitals_of(const std::string& text, int steps, const std::function<void(scenes::Simulation&, int)>& meddle = {}) {
  const scenes::Scene scene = scenes::parse_scene(text, "test.json");
  scenes::Simulation simulation(scene, "boxstream");
  VitalsMonitor monitor(simulation);
  for (int i = 0; i < steps; ++i) {
    if (meddle) meddle(simulation, i);
    simulation.advance(true);
    monitor.look();
  }
  return monitor.vitals();
}

std::string scene(const std::string& bodies, const std::string& more = "") {
  return R"({"format": 1, "meta": {"name": "t", "about": "t", "source": "own"}, "time": {"dt": 0.0166666667, "steps": 60},
    "world": {"gravity": [0, -9.81, 0], "bounds": {"min": [-5, -5, -5], "max": [5, 5, 5]}},
    "shapes": [{"name": "ball", "type": "sphere", "radius": 0.3}, {"name": "floor", "type": "plane", "normal": [0, 1, 0]}],
    "bodies": [)" +
         bodies + "]" + more + "}";
}

const std::string ball = R"({"name": "b", "shape": "ball", "mass": 2, "position": [0, 0.3, 0]})";
const std::string floor = R"({"shape": "floor", "type": "static", "position": [0, 0, 0]})";

TEST(Vitals, WhatRestsIsSound) {
  const Vitals vitals = vitals_of(scene(ball + "," + floor), 60);
  EXPECT_EQ(unsound(vitals), "");
  EXPECT_FALSE(vitals.conserves);
}

TEST(Vitals, GainsOfEnergyAreNot) {
  // It is thrown up from outside, in the middle of a step of the engine: no work explains it.
  const Vitals vitals = vitals_of(scene(ball + "," + floor), 60, [](scenes::Simulation& s, int step) {
    if (step != 20) return;
    s.set_after_pairs([&s] {
      auto* const body = const_cast<btRigidBody*>(btRigidBody::upcast(s.objects()[0]));
      body->setLinearVelocity(btVector3(0, 3, 0));
      s.set_after_pairs({});
    });
  });
  EXPECT_NE(unsound(vitals).find("gains"), std::string::npos) << unsound(vitals);
}

TEST(Vitals, EnergyOfWhatIsTakenOutDoesNotVanish) {
  const std::string leaving = R"({"shape": "ball", "mass": 2, "position": [4, 0, 0], "velocity": [4, 0, 0]})";
  auto document = nlohmann::json::parse(scene(leaving));
  document["world"]["on_leave"] = "remove";
  document["world"]["gravity"] = {0, 0, 0};
  const Vitals vitals = vitals_of(document.dump(), 60);
  EXPECT_GT(vitals.most_in_world, 15);
  EXPECT_LT(vitals.energy.now, 1) << "it is still there";
  EXPECT_EQ(unsound(vitals), "");
}

TEST(Vitals, EnergyThatNothingTakesMayNotVanish) {
  const std::string moving = R"({"shape": "ball", "mass": 2, "position": [-2, 0, 0], "velocity": [4, 4, 0]})";
  const auto drained = [](scenes::Simulation& s, int) {
    auto* const body = const_cast<btRigidBody*>(btRigidBody::upcast(s.objects()[0]));
    body->setLinearVelocity(body->getLinearVelocity() * btScalar(0.97));
  };
  EXPECT_EQ(unsound(vitals_of(scene(moving), 30)), "");
  const Vitals vitals = vitals_of(scene(moving), 30, drained);
  EXPECT_TRUE(vitals.conserves);
  EXPECT_NE(unsound(vitals).find("which nothing takes"), std::string::npos)
      << unsound(vitals) << vitals.vanished << " J of " << vitals.most_in_world;
}

TEST(Vitals, BodiesThatLeaveAreCountedAgainstThoseThatLeaveAnyway) {
  const Vitals vitals = vitals_of(scene(ball), 90);
  EXPECT_EQ(vitals.outside, 1u);
  EXPECT_NE(unsound(vitals, {}).find("1 body left"), std::string::npos);
  EXPECT_EQ(unsound(vitals, {1}), "");
}

TEST(Vitals, DepthIsAShareOfTheThinnerBody) {
  const std::string deep = R"({"shape": "ball", "mass": 2, "position": [0, 0, 0]})";
  const Vitals vitals = vitals_of(scene(deep + "," + floor), 1);
  EXPECT_NEAR(vitals.deepest, 0.3, 0.05);
  EXPECT_NEAR(vitals.deepest_share, 0.5, 0.08);
  EXPECT_NE(unsound(vitals).find("in each other"), std::string::npos) << unsound(vitals);
}

TEST(Vitals, ChecksOfTheSceneDecide) {
  const Vitals vitals =
      vitals_of(scene(ball + "," + floor, R"(, "checks": [{"metric": "highest", "op": ">", "value": 1}])"), 5);
  ASSERT_EQ(vitals.failed_checks.size(), 1u);
  EXPECT_NE(unsound(vitals).find("breaks a check of the scene: highest > 1"), std::string::npos) << unsound(vitals);
}

TEST(Vitals, FallingIsWrongOnlyWhereTheReferenceStands) {
  Vitals run, reference;
  run.height_loss = 0.6;
  EXPECT_EQ(unsound(run), "");
  EXPECT_NE(unsound(run, {0, &reference}).find("loses 60 % of its height"), std::string::npos);
  reference.height_loss = 0.58;
  EXPECT_EQ(unsound(run, {0, &reference}), "");
  run.height_loss = -0.5;
  EXPECT_EQ(unsound(run, {0, &reference}), "");
}

TEST(Vitals, LossOfEnergyIsWrongWhereTheReferenceLosesLess) {
  Vitals run, reference;
  run.most_in_world = reference.most_in_world = 10;
  run.energy.first = 10;
  run.energy.now = 7.9;
  reference.energy.first = 10;
  reference.energy.now = 9.5;
  EXPECT_EQ(unsound(run), "");
  EXPECT_NE(unsound(run, {0, nullptr, "the reference", &reference})
                .find("loses 2.1 J of 10 J, where the reference loses 0.5 J"),
            std::string::npos);
  run.energy.now = 9;
  EXPECT_EQ(unsound(run, {0, nullptr, "the reference", &reference}), "");
}

}  // namespace
}  // namespace boxstream::accuracy_test
