// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "gallery.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::effects_test {
namespace {

using scenes::Simulation;

std::map<std::string, std::uint64_t> activity_of(const scenes::Scene& scene,
                                                 effects::Extent extent = effects::Extent::only_called) {
  Simulation simulation(scene, "boxstream", {}, extent);
  for (int i = 0; i < scene.time.steps; ++i) simulation.step();
  std::map<std::string, std::uint64_t> counts;
  for (const scenes::EffectActivity& each : simulation.activity()) counts[each.effect->name] = each.count;
  return counts;
}

const Names untold{"monitors", "recording", "threads"};

class ActivityOf : public testing::TestWithParam<Exhibit> {};

TEST_P(ActivityOf, IsToldOfWhatIsOnAndIsThere) {
  const std::string name = GetParam().name;
  const auto counts = activity_of(exhibit(name));
  Names told;
  for (const auto& [effect, count] : counts) told.insert(effect);
  Names expected = names_of(GetParam());
  for (const std::string& effect : untold) expected.erase(effect);
  if (name == "ccd_on_demand") expected.insert("ccd");  // the run switches it on
  EXPECT_EQ(told, expected);
  if (counts.count(name) > 0) {
    EXPECT_GT(counts.at(name), 0) << "on, and never acted";
  }
}

INSTANTIATE_TEST_SUITE_P(Gallery, ActivityOf, testing::ValuesIn(gallery()),
                         [](const auto& test) { return name_of_exhibit(test.param); });

TEST(Activity, IsNoneWhereEverythingIsBuiltAndNothingCallsForIt) {
  // Bodies glide: what is set up and slept, swept or told of them is there.
  for (const auto& [effect, count] : activity_of(exhibit("nothing"), effects::Extent::all))
    EXPECT_EQ(count, 0) << effect;
}

TEST(Activity, IsNoneOfAnEffectThatWaits) {
  nlohmann::json document = document_of("restitution");
  document["bodies"][0]["position"][1] = 9;
  document["time"]["steps"] = 5;
  document.erase("expect");
  const auto counts = activity_of(scene_of(document));
  EXPECT_EQ(counts.at("restitution"), 0);
  EXPECT_EQ(counts.at("contacts"), 0);
  EXPECT_EQ(counts.at("gravity"), 5);
}

// Nothing meets, so there are no contacts, and the broad-phase is left alone.
TEST(Activity, IsToldOfPairsKeptApartWhereNothingElseMeets) {
  const auto counts = [](const char* what, const nlohmann::json& value) {
    nlohmann::json document = document_of("contacts");
    document.erase("expect");
    document["time"]["steps"] = 120;
    document["bodies"][0]["position"] = {0, 3, 0};
    document = document.patch({{{"op", "add"}, {"path", what}, {"value", value}}});
    return activity_of(scene_of(document));
  };
  const auto apart = counts("/exclusions", nlohmann::json::array({nlohmann::json::array({"ball", "ground"})})),
             masked = counts("/bodies/0/mask", 4);
  EXPECT_FALSE(apart.contains("contacts"));
  EXPECT_FALSE(masked.contains("contacts"));
  // A ball of 0.5 m falls 2.5 m, and then through a ground of 2 m: two bodies of 3 m in all.
  const double steps = 60 * (std::sqrt(2 * 5.5 / 9.81) - std::sqrt(2 * 2.5 / 9.81));
  EXPECT_NEAR(static_cast<double>(apart.at("exclusions")), steps, 1.5);
  EXPECT_EQ(masked.at("collision_filters"), apart.at("exclusions"));
}

TEST(Activity, CountsStepsThatAreObserved) {
  Simulation simulation(exhibit("gravity"), "boxstream");
  simulation.step();
  simulation.advance();
  simulation.step();
  ASSERT_EQ(simulation.activity().size(), 1u);
  EXPECT_EQ(simulation.activity()[0].count, 2u);
}

}  // namespace
}  // namespace boxstream::effects_test
