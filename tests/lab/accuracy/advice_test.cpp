// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "accuracy/advice.hpp"
#include "accuracy/usual_knobs.hpp"
#include "formats/scene_json/load_scene.hpp"

namespace boxstream::accuracy_test {
namespace {

using namespace accuracy;

/// Eight links of 1 kg hang straight down, with `load` kg at their end.
nlohmann::json chain(double load) {
  auto scene = nlohmann::json::parse(R"({
    "format": 1, "meta": {"name": "chain", "about": "a chain bears a load", "source": "own"},
    "time": {"dt": 0.016666666666666666, "steps": 120},
    "world": {"bounds": {"min": [-9, -19, -9], "max": [9, 9, 9]}},
    "shapes": [{"name": "link", "type": "capsule", "radius": 0.1, "height": 0.2},
               {"name": "load", "type": "sphere", "radius": 0.5}],
    "generators": [{"type": "chain", "links": 8, "anchor": [0, 0, 0], "direction": [0, -1, 0], "pitch": 0.5,
                    "end_offset": 0.5, "link": {"shape": "link", "mass": 1, "sleep": false},
                    "end": {"shape": "load", "sleep": false}}]
  })");
  scene["generators"][0]["end"]["mass"] = load;
  return scene;
}

/// One row for each cost, of which the first is the scene as it is; those with a reason are not sound.
Advice among(const std::vector<std::pair<double, std::string>>& rows) {
  Request request;
  request.knobs = {parse_knob("substeps=1,2,4,8")};
  request.measures = {parse_measure("penetration")};
  Sweep sweep;
  for (const auto& [ms, reason] : rows) {
    Row row;
    row.setting = {1 << sweep.rows.size()};
    row.ms = {ms, ms - 0.1, ms + 0.1, ms};
    row.series = {{}};
    row.unsound = reason;
    sweep.rows.push_back(row);
  }
  sweep.own = 0;
  return advice_of(request, sweep, 0, HUGE_VAL);
}

TEST(Advice, IsTheCheapestSoundSettingAndItsPrice) {
  const Advice advice = among({{2, "breaks"}, {1, "gains energy"}, {4, ""}, {6, ""}});
  EXPECT_EQ(advice.best, 2u);
  ASSERT_TRUE(advice.price);
  EXPECT_DOUBLE_EQ(advice.price->value, 2);
  EXPECT_DOUBLE_EQ(advice.price->low, 3.9 / 2.1);
  EXPECT_DOUBLE_EQ(advice.price->high, 4.1 / 1.9);
}

TEST(Advice, IsTheSceneAsItIsWhereNothingElseIsCheaper) {
  EXPECT_TRUE(among({{2, ""}, {2.1, ""}}).is_scene_as_it_is());
  EXPECT_TRUE(among({{2, ""}, {1.9, ""}}).is_scene_as_it_is());
  EXPECT_FALSE(among({{2, ""}, {1, ""}}).is_scene_as_it_is());
  EXPECT_FALSE(among({{2, "breaks"}, {3, "breaks"}}).best);
}

TEST(Advice, IsAnotherSettingWhereTheSceneAsItIsGivesWay) {
  Request request = advice_request(chain(3000), "chain.json", 20);
  request.repeats = 3;
  const Advice advice = advise(request, [](const Stage&) {});
  ASSERT_NE(advice.own_row(), nullptr);
  EXPECT_NE(advice.own_row()->unsound, "");
  ASSERT_TRUE(advice.best);
  EXPECT_FALSE(advice.is_scene_as_it_is());
  EXPECT_TRUE(advice.best_row()->may_be_advised());
  ASSERT_TRUE(advice.price);
  EXPECT_LE(advice.price->low, advice.price->value);
  EXPECT_LE(advice.price->value, advice.price->high);
  for (const Row& row : advice.sweep.rows)
    EXPECT_TRUE(!row.may_be_advised() || row.ms.high >= advice.best_row()->ms.low) << row.label;
}

/// So many cubes of 5 cm one upon the other, which ten iterations in one step do not hold.
nlohmann::json tower(int cubes) {
  auto scene = nlohmann::json::parse(R"({
    "format": 1, "meta": {"name": "tower", "about": "a tower falls", "source": "own"},
    "time": {"dt": 0.016666666666666666, "steps": 300},
    "world": {"bounds": {"min": [-9, -9, -9], "max": [9, 9, 9]}},
    "shapes": [{"name": "cube", "type": "box", "half_extents": [0.025, 0.025, 0.025]},
               {"name": "floor", "type": "box", "half_extents": [3, 1, 3]}],
    "bodies": [{"shape": "floor", "type": "static", "position": [0, -1, 0]}]
  })");
  for (int i = 0; i < cubes; ++i)
    scene["bodies"].push_back({{"shape", "cube"}, {"mass", 1}, {"position", {0.0001 * (i % 3), 0.025 + 0.05 * i, 0}}});
  return scene;
}

// No time for any reference: what the others hold can stand, and what is not known to be right is not advised.
TEST(Advice, IsNotWhatFallsWhereNothingSaysThatItShould) {
  for (const double budget : {1.0, 4.0, 10.0}) {
    const Advice advice = advise(advice_request(tower(21), "tower.json", budget), [](const Stage&) {});
    ASSERT_NE(advice.own_row(), nullptr) << budget;
    EXPECT_NE(advice.own_row()->unsound, "") << budget;
    EXPECT_FALSE(advice.is_scene_as_it_is()) << budget;
    if (advice.best) {
      EXPECT_LT(advice.best_row()->vitals.height_loss, 0.1) << budget;
    }
  }
}

TEST(Advice, TriesMultibodiesWhereTheyHoldAllJoints) {
  const auto tried = [](const nlohmann::json& scene) {
    return usual_knobs(scenes::parse_scene(scene.dump(), "scene.json")).front().values;
  };
  nlohmann::json hanging = chain(10);
  EXPECT_EQ(tried(hanging), (std::vector<nlohmann::json>{"sequential_impulses", "dantzig", "multibodies"}));
  EXPECT_EQ(tried(tower(3)), (std::vector<nlohmann::json>{"sequential_impulses", "dantzig"}));
  // What springs do, no link does.
  hanging["bodies"] = {{{"name", "b"}, {"shape", "load"}, {"mass", 1}, {"position", {3, 0, 0}}}};
  hanging["joints"] = {{{"type", "spring"}, {"a", "b"}, {"pivot", {3, 1, 0}}, {"stiffness", 100}, {"damping", 0}}};
  EXPECT_EQ(tried(hanging), (std::vector<nlohmann::json>{"sequential_impulses", "dantzig"}));
}

TEST(Advice, TurnsKnobsThatSeldomHelpWhereTheyMay) {
  const auto tried = [](const nlohmann::json& scene, bool has_doubles) {
    std::string names;
    for (const Knob& knob : usual_knobs(scenes::parse_scene(scene.dump(), "scene.json"), has_doubles))
      if (knob.is_rare) names += knob.name + " ";
    return names;
  };
  // Links of 20 cm, with a load that is heavier by up to so much.
  EXPECT_EQ(tried(chain(100), true), "step ");
  EXPECT_EQ(tried(chain(1000), true), "precision step ");
  EXPECT_EQ(tried(chain(1000), false), "step ");
  // The same by volumes: links of 0.01047 m^3, a load of 0.5236 m^3.
  nlohmann::json dense = chain(1);
  dense["generators"][0]["link"] = {{"shape", "link"}, {"density", 200}};
  dense["generators"][0]["end"] = {{"shape", "load"}, {"density", 5000}};
  EXPECT_EQ(tried(dense, true), "precision step ") << "1250 times";
  dense["generators"][0]["end"]["density"] = 3800;
  EXPECT_EQ(tried(dense, true), "step ") << "950 times";
  // Cubes of 5 cm, up to 20 km away.
  nlohmann::json cubes = tower(2);
  EXPECT_EQ(tried(cubes, true), "margin step ");
  cubes["shapes"][0]["margin"] = 0.001;
  EXPECT_EQ(tried(cubes, true), "step ");
  cubes["bodies"][1]["position"][0] = 20000;
  EXPECT_EQ(tried(cubes, true), "precision step ");
  cubes["checks"] = {{{"metric", "lowest"}, {"op", ">"}, {"value", -9}}};
  EXPECT_EQ(tried(cubes, true), "precision ");
}

TEST(Advice, TurnsOneKnobThatSeldomHelpsAtATime) {
  Request request = advice_request(chain(3000), "chain.json", 20);
  request.knobs = {parse_knob("step=0.016666666666666666,0.008"), parse_knob("iterations=10,20"),
                   parse_knob("substeps=1,2")};
  request.knobs.front().is_rare = true;
  request.repeats = 1;
  std::set<std::string> tried;
  request.seek->bound = 0;  // all are
  for (const Row& row : run(request, [](const Stage&) {}).rows) tried.insert(row.label);
  EXPECT_TRUE(tried.count("step=0.008 iterations=10 substeps=2"));
  EXPECT_FALSE(tried.count("step=0.008 iterations=20 substeps=1"));
}

}  // namespace
}  // namespace boxstream::accuracy_test
