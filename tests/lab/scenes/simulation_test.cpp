// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <LinearMath/btQuickprof.h>

#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/names.hpp"
#include "formats/scene_model/scene_error.hpp"
#include "shipped.hpp"
#include "simulation/engine/broadphases.hpp"
#include "simulation/run/pair_check.hpp"
#include "simulation/run/simulation.hpp"
#include "small_scene.hpp"

namespace boxstream::scenes_test {
namespace {

using scenes::Simulation;
using scenes::StepOptions;
using scenes::StepResult;

scenes::Scene small() {
  return scenes::parse_scene(small_scene, "small");
}

class Repeats : public testing::TestWithParam<std::tuple<Shipped, std::string>> {};

TEST_P(Repeats, SameStateInEveryStep) {
  const auto& [shipped, broadphase] = GetParam();
  const scenes::Scene scene = reduced(shipped);
  Simulation first(scene, broadphase), second(scene, broadphase);
  ASSERT_EQ(first.state_hash(), second.state_hash());
  std::uint64_t former = first.state_hash();
  for (int i = 0; i < steps_of(shipped) / 2; ++i) {
    const std::uint64_t hash = first.step().state_hash;
    // One of the two is watched closely, which must not show.
    StepOptions options;
    options.exact_pairs = true;
    second.set_after_pairs([&] { (void)scenes::check_pairs(second); });
    ASSERT_EQ(hash, second.step(options).state_hash) << "step " << i + 1;
    ASSERT_NE(hash, former) << "nothing moved in step " << i + 1;
    ASSERT_EQ(first.pairs(), second.pairs());
    former = hash;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Repeats,
                         testing::Combine(testing::ValuesIn(shipped_scenes), testing::Values("boxstream", "dbvt")),
                         [](const auto& test) {
                           return std::get<0>(test.param).name + "_on_" + std::get<1>(test.param);
                         });

TEST(Simulation, ASceneWithEverythingRunsOnEveryBroadphase) {
  for (const std::string& name : scenes::broadphase_names()) {
    Simulation simulation(small(), name);
    const scenes::Census census = simulation.census();
    EXPECT_EQ(census.kinematic, 1u);
    EXPECT_EQ(census.joints, 3u + 3u + 10u);
    EXPECT_EQ(census.soft_bodies, 2u);
    EXPECT_EQ(census.characters, 1u);
    EXPECT_EQ(census.shapes[scenes::ShapeValue(scenes::CompoundShape{}).index()], 1u);
    for (int i = 0; i < 30; ++i) {
      const StepResult result = simulation.step();
      EXPECT_EQ(result.step, static_cast<std::uint64_t>(i) + 1);
      EXPECT_EQ(result.bodies, census.objects);
    }
    EXPECT_EQ(simulation.steps_done(), 30u);
    EXPECT_TRUE(simulation.is_finite()) << name;
  }
}

TEST(Simulation, PinnedCornersOfAClothStayAndTheOthersFall) {
  Simulation simulation(small(), "boxstream");
  for (int i = 0; i < 30; ++i) simulation.step();
  std::vector<std::array<float, 3>> cloth;
  simulation.for_each_drawable([&](const scenes::Drawable& drawable) {
    if (drawable.state == scenes::Drawable::State::soft && drawable.vertices.size() == 16)
      cloth.assign(drawable.vertices.begin(), drawable.vertices.end());
  });
  ASSERT_EQ(cloth.size(), 16u);
  EXPECT_EQ(cloth[0], (std::array<float, 3>{-3, 5, -3}));
  EXPECT_EQ(cloth[15], (std::array<float, 3>{-1, 5, -1}));
  EXPECT_LT(cloth[3][1], 4.9f);
  EXPECT_LT(cloth[12][1], 4.9f);
}

TEST(Simulation, RaysHitWhatIsBelowThemAndDisturbNothing) {
  scenes::Scene scene = small();
  ASSERT_EQ(scene.queries.size(), 1u);
  Simulation with(scene, "boxstream");
  std::get<scenes::RayFan>(scene.queries[0]).drop = 1;  // ends in the air, above everything
  Simulation above(scene, "dbvt");
  scene.queries.clear();
  Simulation without(scene, "boxstream");
  for (int i = 0; i < 10; ++i) {
    const StepResult result = with.step();
    EXPECT_EQ(result.ray_hits, 8u);  // all reach the ground, if nothing else
    EXPECT_GT(result.queries_ms, 0);
    EXPECT_EQ(above.step().ray_hits, 0u);
    const StepResult quiet = without.step();
    EXPECT_EQ(quiet.queries_ms, 0);
    EXPECT_EQ(quiet.state_hash, result.state_hash);
  }
}

TEST(Simulation, UnknownBroadphaseListsTheKnownOnes) {
  try {
    Simulation simulation(small(), "octree");
    FAIL() << "accepted";
  } catch (const scenes::UnknownBroadphase& error) {
    EXPECT_STREQ(error.what(),
                 "unknown broad-phase 'octree'; there are boxstream, hybrid, dbvt, dbvt-deferred, sap, simple");
  }
}

TEST(Simulation, TimesAreThoseOfTheZonesAndTheProfilerIsPutBack) {
  btEnterProfileZoneFunc* const enter = btGetCurrentEnterProfileZoneFunc();
  btLeaveProfileZoneFunc* const leave = btGetCurrentLeaveProfileZoneFunc();
  Simulation simulation(reduced({"pile", 0.06, 0}), "dbvt");
  for (int i = 0; i < 20; ++i) {
    const StepResult result = simulation.step();
    EXPECT_GT(result.update_aabbs_ms, 0);
    EXPECT_GT(result.overlapping_pairs_ms, 0);
    EXPECT_GT(result.dispatch_ms, 0);
    EXPECT_GT(result.solve_ms, 0);
    EXPECT_DOUBLE_EQ(result.broadphase_ms, result.update_aabbs_ms + result.overlapping_pairs_ms);
    EXPECT_GT(result.step_ms, result.broadphase_ms + result.dispatch_ms + result.solve_ms);
  }
  EXPECT_EQ(btGetCurrentEnterProfileZoneFunc(), enter);
  EXPECT_EQ(btGetCurrentLeaveProfileZoneFunc(), leave);
}

TEST(Simulation, WhatTheCallbackThrowsComesOutOfTheStep) {
  Simulation simulation(small(), "boxstream");
  simulation.set_after_pairs([] { throw std::runtime_error("seen enough"); });
  EXPECT_THROW(simulation.step(), std::runtime_error);
  simulation.set_after_pairs({});
  EXPECT_EQ(simulation.step().step, 2u);
}

TEST(Simulation, CheckNoticesPairsThatAreMissingAndPairsTooMany) {
  Simulation simulation(reduced({"pile", 0.06, 0}), "boxstream");
  while (simulation.pairs().size() < 20) simulation.step();
  ASSERT_EQ(scenes::check_pairs(simulation), "");
  // Forge the boxes that the oracle reads, behind the broad-phase's back.
  btBroadphaseProxy& proxy = *simulation.objects()[300]->getBroadphaseHandle();
  const btVector3 max = proxy.m_aabbMax;
  proxy.m_aabbMax += btVector3(50, 50, 50);
  EXPECT_NE(scenes::check_pairs(simulation).find("first missing: objects"), std::string::npos);
  proxy.m_aabbMax = max;
  ASSERT_EQ(scenes::check_pairs(simulation), "");
  const std::uint32_t touching = simulation.pairs().back().b;
  btBroadphaseProxy& other = *simulation.objects()[touching]->getBroadphaseHandle();
  const btVector3 former_min = other.m_aabbMin, former_max = other.m_aabbMax;
  other.m_aabbMin = other.m_aabbMax = btVector3(0, 500, 0);
  EXPECT_NE(scenes::check_pairs(simulation).find("first extra: objects"), std::string::npos);
  other.m_aabbMin = former_min;
  other.m_aabbMax = former_max;
}

TEST(Simulation, ExpectationsThatDoNotHoldAreNamed) {
  scenes::Scene scene = small();
  Simulation simulation(scene, "boxstream");
  EXPECT_EQ(scenes::check_expectations(scene, simulation.census()), "");
  scene.expect.sensors = 2;
  EXPECT_EQ(scenes::check_expectations(scene, simulation.census()), "small: expected 2 sensors, built 1");
}

}  // namespace
}  // namespace boxstream::scenes_test
