// SPDX-License-Identifier: MIT
// No step of a scene that is shipped gains energy that no work explains, but for those that are named with the reason.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <ostream>

#include "formats/scene_json/load_scene.hpp"
#include "scenes/energy_gains.hpp"
#include "scenes/shipped.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::effects_test {
namespace {

using scenes::EnergyBalance;
using scenes::Simulation;

struct SceneRun {
  std::string scene;
  double factor;  ///< of the number of bodies
};

void PrintTo(const SceneRun& run, std::ostream* out) {
  *out << run.scene;
}

/// Set BOXSTREAM_WHOLE_RUNS to have all bodies and all steps: many minutes instead of one.
bool whole_runs() {
  return std::getenv("BOXSTREAM_WHOLE_RUNS") != nullptr;
}

/// How many bodies are moved by a step, in all steps.
constexpr int most_moves = 100'000 / scenes_test::slowness;

std::vector<SceneRun> runs() {
  std::vector<SceneRun> all;
  for (const scenes_test::Shipped& shipped : scenes_test::shipped_scenes)
    all.push_back({shipped.name, whole_runs() ? 1 : shipped.factor});
  for (const std::string folder : {"hard", "effects"})
    for (const auto& entry : std::filesystem::directory_iterator(scenes::shipped(folder)))
      if (entry.path().extension() == ".json") all.push_back({folder + "/" + entry.path().stem().string(), 1});
  std::sort(all.begin(), all.end(), [](const SceneRun& a, const SceneRun& b) { return a.scene < b.scene; });
  return all;
}

EnergyBalance balance_of(const SceneRun& run) {
  scenes::Scene scene = scenes::load_scene(scenes_test::file_of(run.scene));
  if (run.factor != 1) scene = scenes::scaled(scene, run.factor);
  scene.checks.clear();
  Simulation simulation(scene, "boxstream");
  const auto bodies = static_cast<int>(simulation.objects().size());
  const int steps = whole_runs() ? scene.time.steps : std::min(scene.time.steps, most_moves / bodies + 20);
  for (int i = 0; i < steps; ++i) simulation.advance(true);
  return simulation.energy_balance();
}

class EnergyOfShipped : public ::testing::TestWithParam<SceneRun> {};

TEST_P(EnergyOfShipped, Scene) {
  const EnergyBalance balance = balance_of(GetParam());
  EXPECT_GT(balance.steps, 0U);
  const double share = balance.worst ? balance.worst->share : 0;
  const auto known = std::find_if(scenes_test::gaining_scenes.begin(), scenes_test::gaining_scenes.end(),
                                  [](const auto& each) { return each.name == GetParam().scene; });
  if (known == scenes_test::gaining_scenes.end()) {
    EXPECT_EQ(balance.gains, 0U) << "worst: step " << balance.worst->step << ", body " << balance.worst->body << ", "
                                 << balance.worst->energy << " J, share " << share;
  } else {
    EXPECT_GE(share, known->least) << "it gains less than it did (" << known->reason << "): say so";
    EXPECT_LE(share, known->most) << known->reason;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EnergyOfShipped, ::testing::ValuesIn(runs()), [](const auto& of) {
  std::string name = of.param.scene;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

TEST(EnergyOfShipped, ThatGainIsAShippedScene) {
  const std::vector<SceneRun> all = runs();
  for (const scenes_test::GainingScene& gaining : scenes_test::gaining_scenes)
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const SceneRun& run) { return run.scene == gaining.name; }))
        << gaining.name;
}

}  // namespace
}  // namespace boxstream::effects_test
