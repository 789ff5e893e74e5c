// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "formats/scene_json/load_scene.hpp"
#include "gallery.hpp"
#include "simulation/run/simulation.hpp"
#include "simulation/run/state_hash.hpp"

namespace boxstream::effects_test {
namespace {

using scenes::Simulation;

constexpr int steps = 60;

/// Boxes and balls that fall on each other.
scenes::Scene pile() {
  return scenes::scaled(scenes::load_scene(scenes::shipped("pile.json")), 0.02);
}

/// Hashes of the rigid bodies after each step.
std::vector<std::uint64_t> trajectory(Simulation& simulation, std::size_t bodies) {
  std::vector<std::uint64_t> hashes;
  std::vector<float> state;
  for (int i = 0; i < steps; ++i) {
    simulation.advance();
    scenes::collect_state({simulation.objects().begin(), simulation.objects().begin() + static_cast<long>(bodies)},
                          state);
    hashes.push_back(scenes::hash_of(state));
  }
  return hashes;
}

std::vector<std::uint64_t> trajectory(const scenes::Scene& scene, std::size_t bodies) {
  Simulation simulation(scene, "boxstream");
  return trajectory(simulation, bodies);
}

TEST(Neutral, LookingOnChangesNoTrajectory) {
  const scenes::Scene plain = pile();
  const std::size_t bodies = Simulation(plain, "boxstream").census().bodies;
  const auto expected = trajectory(plain, bodies);
  ASSERT_NE(expected.front(), expected.back());
  const auto with = [&](auto edit) {
    scenes::Scene scene = plain;
    edit(scene);
    EXPECT_GT(on(effects::plan(scene)).size(), on(effects::plan(plain)).size());
    return trajectory(scene, bodies);
  };
  EXPECT_EQ(with([](scenes::Scene& scene) { scene.sensors.push_back({"middle", {3, 3, 3}, {0, 3, 0}}); }), expected);
  EXPECT_EQ(with([](scenes::Scene& scene) {
              scene.queries.push_back(scenes::RayFan{16, {0, 20, 0}, 5, 20, 3});
            }),
            expected);
  EXPECT_EQ(with([](scenes::Scene& scene) {
              scene.queries.push_back(scenes::BoxQuery{{{-2, 0, -2}, {2, 2, 2}}});
            }),
            expected);
  EXPECT_EQ(with([](scenes::Scene& scene) { scene.queries.push_back(scenes::ContactQuery{0}); }), expected)
      << "contactTest";
  EXPECT_EQ(with([](scenes::Scene& scene) {
              scene.checks.push_back({scenes::Check::Metric::missed_pairs, scenes::Check::Op::equal, 0});
            }),
            expected);
  EXPECT_EQ(with([](scenes::Scene& scene) { scene.outputs.record.push_back("pile.bsrec"); }), expected);
  EXPECT_EQ(with([](scenes::Scene& scene) { scene.world.on_leave = scenes::OnLeave::report; }), expected);
}

/// Built though nothing calls for it, each effect alone: the trajectory stays, but for these.
TEST(Neutral, WhatIsBuiltForNothingDoesNothing) {
  const Names not_neutral{
      "ccd",           // boxes that cover the motion of a step are larger: other pairs, in another order
      "forced_boxes",  // Bullet makes the box of a fixed body larger when it sets it again
  };
  const scenes::Scene scene = pile();
  const effects::Plan called = effects::plan(scene);
  Simulation plain(scene, "boxstream", {}, called);
  const std::size_t bodies = plain.census().bodies;
  const auto expected = trajectory(plain, bodies);
  for (std::size_t i = 0; i < called.size(); ++i) {
    if (called[i].on) continue;
    effects::Plan one_more = called;
    one_more[i].on = true;
    Simulation simulation(scene, "boxstream", {}, one_more);
    const auto found = trajectory(simulation, bodies);
    EXPECT_EQ(found == expected, not_neutral.count(called[i].effect->name) == 0) << called[i].effect->name;
  }
}

}  // namespace
}  // namespace boxstream::effects_test
