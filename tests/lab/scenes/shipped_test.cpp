// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "formats/scene_json/load_scene.hpp"
#include "shipped.hpp"
#include "simulation/run/pair_check.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::scenes_test {
namespace {

using scenes::Census;
using scenes::Drawable;
using scenes::load_scene;
using scenes::Scene;
using scenes::Simulation;
using scenes::StepResult;

class ShippedScenes : public testing::TestWithParam<Shipped> {};

TEST(ShippedScenes, AreAllListedHere) {
  std::set<std::string> listed, found;
  for (const Shipped& shipped : shipped_scenes) listed.insert(shipped.name);
  for (const auto& entry : std::filesystem::directory_iterator(scenes::shipped()))
    if (const std::string name = entry.path().stem().string();
        entry.path().extension() == ".json" &&
        !name.starts_with("query_"))  // scenes of queries have tests of their own
      found.insert(name);
  EXPECT_EQ(found, listed);
}

TEST_P(ShippedScenes, AreWhatTheySayTheyAre) {
  const Scene scene = load_scene(file_of(GetParam().name));
  EXPECT_EQ(scene.meta.name, GetParam().name);
  ASSERT_TRUE(scene.expect.objects && scene.expect.bodies && scene.expect.fixed && scene.expect.dynamic);
  Simulation simulation(scene, "boxstream");
  EXPECT_EQ(scenes::check_expectations(scene, simulation.census()), "");
  EXPECT_EQ(simulation.objects().size(), *scene.expect.objects);
  EXPECT_EQ(simulation.outside(), 0u);
  EXPECT_TRUE(simulation.is_finite());
}

TEST_P(ShippedScenes, StartRightAtFullSize) {
  const Scene whole = load_scene(file_of(GetParam().name));
  Simulation simulation(tests::sanitized ? scenes::scaled(whole, 0.3) : whole, "boxstream");
  simulation.set_after_pairs([&] {
    ASSERT_EQ(scenes::check_pairs(simulation), "");
    ASSERT_EQ(scenes::check_ghosts(simulation), "");
  });
  for (int i = 0; i < 3; ++i) simulation.step();
  EXPECT_TRUE(simulation.is_finite());
  EXPECT_EQ(simulation.outside(), 0u);
}

TEST_P(ShippedScenes, DrawEverything) {
  Simulation simulation(reduced(GetParam()), "boxstream");
  simulation.step();
  std::set<std::uint32_t> seen;
  simulation.for_each_drawable([&](const Drawable& drawable) {
    seen.insert(drawable.object);
    for (const float x : drawable.position) ASSERT_TRUE(std::isfinite(x));
    // Rows of a rotation are unit vectors.
    for (std::size_t row = 0; row < 3; ++row) {
      const float* const r = &drawable.rotation[3 * row];
      ASSERT_NEAR(r[0] * r[0] + r[1] * r[1] + r[2] * r[2], 1, 1e-4);
    }
    if (drawable.kind == Drawable::Kind::triangles) {
      ASSERT_FALSE(drawable.triangles.empty());
      for (const auto& triangle : drawable.triangles)
        for (const std::uint32_t corner : triangle) ASSERT_LT(corner, drawable.vertices.size());
    } else {
      ASSERT_NE(drawable.size, (std::array<float, 3>{}));
    }
  });
  EXPECT_EQ(seen.size(), simulation.objects().size());
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScenes, testing::ValuesIn(shipped_scenes),
                         [](const auto& test) { return test.param.name; });

/// What each scene is about has to happen in it.
TEST(ShippedScenesRun, BodiesOfTheStormStayFastAndSpreadOut) {
  Simulation simulation(reduced({"storm", 0.03, 0}), "boxstream");
  StepResult last;
  for (int i = 0; i < 240 / slowness; ++i) last = simulation.step();
  int moving = 0;
  simulation.for_each_drawable([&](const Drawable& drawable) { moving += drawable.state == Drawable::State::moving; });
  EXPECT_EQ(moving, 600);
  EXPECT_EQ(simulation.outside(), 0u);
  EXPECT_GT(last.begun + last.ended, 10u);
}

TEST(ShippedScenesRun, CharactersMeetCratesAndTriggers) {
  Simulation simulation(load_scene(file_of("character")), "boxstream");
  std::uint64_t least = ~std::uint64_t{0}, most = 0;
  for (int i = 0; i < 300 / slowness; ++i) {
    const StepResult result = simulation.step();
    least = std::min(least, result.ghost_overlaps);
    most = std::max(most, result.ghost_overlaps);
  }
  EXPECT_GT(least, 50u);
  EXPECT_GT(most, least);
}

TEST(ShippedScenesRun, BallBreaksTheWall) {
  if (slowness > 1) GTEST_SKIP() << "takes too long under sanitizers";
  Simulation simulation(load_scene(file_of("wall")), "boxstream");
  for (int i = 0; i < 200; ++i) simulation.step();
  int displaced = 0;
  Simulation untouched(load_scene(file_of("wall")), "boxstream");
  std::vector<std::array<float, 3>> start;
  untouched.for_each_drawable([&](const Drawable& drawable) { start.push_back(drawable.position); });
  simulation.for_each_drawable([&](const Drawable& drawable) {
    const auto& from = start[drawable.object];
    if (std::abs(drawable.position[2] - from[2]) > 0.5f) ++displaced;
  });
  EXPECT_GT(displaced, 30);
  EXPECT_TRUE(simulation.is_finite());
}

}  // namespace
}  // namespace boxstream::scenes_test
