// SPDX-License-Identifier: MIT
#include "boxstream/explain/hard_cases.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_json/shipped_scenes.hpp"

namespace boxstream::tool_test {
namespace {

std::vector<tool::HardCase> cases_of(const std::string& name) {
  return tool::hard_cases(scenes::load_scene(scenes::shipped(name + ".json")));
}

TEST(HardCases, NamesTheSettingsOfTheWorldThatASceneIs) {
  const std::pair<const char*, const char*> worlds[] = {{"ball_and_chain", "ball_and_chain_stable"},
                                                        {"bounce_energy", "bounce_energy_stable"},
                                                        {"chain_40", "chain_40_stable"},
                                                        {"chain_160", "chain_160_stable"},
                                                        {"mass_ratio_400", "mass_ratio_1000_stable"},
                                                        {"mass_ratio_1000", "mass_ratio_1000_stable"},
                                                        {"thin_boxes_on_mesh", "thin_boxes_on_mesh_stable"}};
  for (const auto& [name, stable] : worlds) {
    const std::vector<tool::HardCase> found = cases_of(std::string("hard/") + name);
    ASSERT_EQ(found.size(), 1u) << name;
    EXPECT_EQ(found[0].scene, stable) << name;
  }
}

TEST(HardCases, AreNotOfScenesWithTheseSettings) {
  for (const auto& entry : std::filesystem::directory_iterator(scenes::shipped("hard"))) {
    const std::string name = entry.path().stem().string();
    if (name.ends_with("_stable")) {
      EXPECT_TRUE(cases_of("hard/" + name).empty()) << name;
    }
  }
}

TEST(HardCases, SayWhatOfTheSceneIsHard) {
  EXPECT_EQ(cases_of("hard/chain_160")[0].what, "a chain of 161 joints: it stretches");
  EXPECT_EQ(cases_of("hard/mass_ratio_400")[0].what,
            "bodies of 1 to 400 kg: a heavy one sinks into a light one that it rests on");
  EXPECT_EQ(cases_of("hard/ball_and_chain")[0].what,
            "a chain of 41 joints with a body of 100 times the mass of a link: it stretches");
  EXPECT_TRUE(cases_of("pile").empty());
  EXPECT_TRUE(cases_of("wall").empty());
}

TEST(HardCases, AreOfBodiesThatCanTouch) {
  scenes::Scene scene = scenes::load_scene(scenes::shipped("hard/mass_ratio_400.json"));
  for (scenes::Body& body : scene.bodies)
    if (body.traits.mass == 1) body.traits.mask = 2;
  EXPECT_TRUE(tool::hard_cases(scene).empty());
}

}  // namespace
}  // namespace boxstream::tool_test
