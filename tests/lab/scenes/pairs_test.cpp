// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <tuple>

#include "formats/scene_model/names.hpp"
#include "shipped.hpp"
#include "simulation/engine/broadphases.hpp"
#include "simulation/run/pair_check.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::scenes_test {
namespace {

using scenes::Shadow;
using scenes::Simulation;
using scenes::StepOptions;
using scenes::StepResult;

using Case = std::tuple<Shipped, std::string>;

class EveryStep : public testing::TestWithParam<Case> {};

/// The world runs on the broad-phase under test; its pairs and its ghosts' lists are compared with the oracle in every
/// step, and the world must have had something to show.
TEST_P(EveryStep, PairsAndGhostListsAreRight) {
  const auto& [shipped, broadphase] = GetParam();
  Simulation simulation(reduced(shipped), broadphase);
  std::string difference;
  simulation.set_after_pairs([&] {
    if (difference.empty()) difference = scenes::check_pairs(simulation);
    if (difference.empty()) difference = scenes::check_ghosts(simulation);
  });
  StepOptions options;
  options.exact_pairs = true;
  std::uint64_t begun = 0, ended = 0, last = 0;
  for (int i = 0; i < steps_of(shipped); ++i) {
    const StepResult result = simulation.step(options);
    ASSERT_EQ(difference, "");
    ASSERT_LE(result.exact_pairs, result.pairs);
    ASSERT_EQ(result.pairs, last + result.begun - result.ended);
    last = result.pairs;
    begun += result.begun;
    ended += result.ended;
  }
  // Run short, some scenes have not come to their first pair.
  if (slowness == 1) {
    EXPECT_GT(begun, 0u);
  }
  if (slowness == 1 && !stands_still(simulation.scene())) {
    EXPECT_GT(ended, 0u);
  }
  EXPECT_TRUE(simulation.is_finite());
  // What an arm pushes may fly out of the bounds, as may what rolls down a hill.
  EXPECT_LE(simulation.outside(), shipped.name == "terrain" || shipped.name == "arm" ? 1u : 0u);
}

INSTANTIATE_TEST_SUITE_P(All, EveryStep,
                         testing::Combine(testing::ValuesIn(shipped_scenes), testing::ValuesIn(broadphases())),
                         [](const auto& test) {
                           std::string name = std::get<0>(test.param).name + "_on_" + std::get<1>(test.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

class Lockstep : public testing::TestWithParam<Shipped> {};

/// One world on boxstream, and the other broad-phases fed with the very same boxes.
TEST_P(Lockstep, AllBroadphasesAgree) {
  Simulation simulation(reduced(GetParam()), "boxstream");
  std::vector<std::pair<std::string, std::unique_ptr<Shadow>>> shadows;
  for (const std::string& name : scenes::broadphase_names())
    shadows.emplace_back(name, std::make_unique<Shadow>(simulation, name));
  int compared = 0;
  simulation.set_after_pairs([&] {
    const std::vector<Pair> held = scenes::overlapping_only(simulation, scenes::held_pairs(simulation));
    for (auto& [name, shadow] : shadows) {
      shadow->follow();
      ASSERT_EQ(scenes::overlapping_only(simulation, shadow->pairs()), held) << name;
      if (name == "boxstream" || name == "simple") {
        ASSERT_EQ(shadow->pairs(), held) << name;
      }
      ++compared;
    }
  });
  const int steps = steps_of(GetParam()) / 2;
  for (int i = 0; i < steps && !HasFatalFailure(); ++i) simulation.step();
  EXPECT_EQ(compared, steps * simulation.scene().time.substeps * static_cast<int>(shadows.size()));
}

INSTANTIATE_TEST_SUITE_P(All, Lockstep, testing::ValuesIn(shipped_scenes),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace boxstream::scenes_test
