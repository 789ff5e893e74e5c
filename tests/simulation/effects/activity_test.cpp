// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

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

const Names untold{"observers", "recording", "threads"};

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
