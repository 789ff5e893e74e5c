// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "accuracy/knob.hpp"
#include "formats/scene_json/load_scene.hpp"

namespace boxstream::accuracy_test {
namespace {

using namespace accuracy;
using nlohmann::json;

std::string complaint(const std::string& text) {
  try {
    parse_knob(text);
  } catch (const BadKnob& error) {
    return error.what();
  }
  return "";
}

TEST(Knob, ValuesAreNumbersFractionsTruthsOrText) {
  const Knob knob = parse_knob("/a/b=1,0.5,1/64,true,hull");
  EXPECT_EQ(knob.pointer, "/a/b");
  EXPECT_EQ(knob.values, (std::vector<json>{1, 0.5, 0.015625, true, "hull"}));
}

TEST(Knob, NamesStandForPointers) {
  EXPECT_EQ(parse_knob("substeps=2").pointer, "/time/substeps");
  for (const std::string& name : knob_names()) EXPECT_EQ(parse_knob(name + "=1").pointer[0], '/') << name;
}

TEST(Knob, WhatIsWrongIsSaidInOneLine) {
  EXPECT_EQ(complaint("substeps"), "substeps: a knob is NAME=VALUE,VALUE...");
  EXPECT_EQ(complaint("=1"), "=1: a knob is NAME=VALUE,VALUE...");
  EXPECT_EQ(complaint("substeps=1,,2"), "substeps: an empty value");
  EXPECT_EQ(complaint("substeps=1,"), "substeps: an empty value");
  EXPECT_EQ(complaint("substeps=2,1,2"), "substeps: a value twice");
  EXPECT_EQ(complaint("dt=1/60,0.0166666666666666666667"), "dt: a value twice");
  EXPECT_EQ(complaint("/a~2=1"), "/a~2: no JSON pointer");
  EXPECT_NE(complaint("speed=1").find("there are bounces, cache_friction, contact_erp, dt, "), std::string::npos);
}

TEST(Knob, GridHasAllCombinationsTheLastKnobFastest) {
  const std::vector<Knob> knobs{parse_knob("substeps=1,2"), parse_knob("erp=0.1,0.2,0.3")};
  const std::vector<Setting> all = grid(knobs);
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(label(knobs, all[1]), "substeps=1 erp=0.2");
  EXPECT_EQ(label(knobs, all[3]), "substeps=2 erp=0.1");
}

TEST(Knob, PutsValuesIntoTheScene) {
  const json scene = json::parse(R"({"bodies": [{"friction": 0.5}, {}]})");
  const auto changed = [&](const std::string& text) {
    const std::vector<Knob> knobs{parse_knob(text)};
    return with(scene, knobs, grid(knobs).front());
  };
  EXPECT_EQ(changed("/bodies/0/friction=0.25")["bodies"][0]["friction"], 0.25);
  EXPECT_EQ(changed("/bodies/1/friction=0.25")["bodies"][1]["friction"], 0.25);
  EXPECT_EQ(changed("iterations=20")["solver"]["iterations"], 20);
  EXPECT_EQ(changed("/a~1b=1")["a/b"], 1);
  for (const char* text : {"/bodies/2/friction=1", "/bodies/x=1", "/bodies/0/friction/deeper=1", "/bodies/-1=1"})
    EXPECT_THROW(changed(text), BadKnob) << text;
}

TEST(Knob, StarIsEveryElement) {
  const json scene = json::parse(R"({"bodies": [{"ccd": 1}, {}], "lists": [[1, 2], [3]], "one": {}})");
  const auto changed = [&](const std::string& text) {
    const std::vector<Knob> knobs{parse_knob(text)};
    return with(scene, knobs, grid(knobs).front());
  };
  EXPECT_EQ(changed("/bodies/*/ccd=false")["bodies"], json::parse(R"([{"ccd": false}, {"ccd": false}])"));
  EXPECT_EQ(changed("/lists/*/*=7")["lists"], json::parse("[[7, 7], [7]]"));
  EXPECT_THROW(changed("/one/*/ccd=1"), BadKnob);
  EXPECT_THROW(changed("/none/*/ccd=1"), BadKnob);
}

TEST(Knob, MarginsAreOfShapesThatHaveThem) {
  const json scene =
      json::parse(R"({"shapes": [{"type": "sphere"}, {"type": "box", "margin": 0.1}, {"type": "hull"}]})");
  const std::vector<Knob> knobs{parse_knob("margin=0.002,0.01"), parse_knob("solver=nncg"),
                                parse_knob("step=1/60,1/120")};
  const std::vector<Setting> settings = grid(knobs);
  ASSERT_EQ(settings.size(), 4u);
  const json changed = with(scene, knobs, settings.back());
  EXPECT_EQ(changed["shapes"],
            json::parse(R"([{"type": "sphere"}, {"type": "box", "margin": 0.01}, {"type": "hull", "margin": 0.01}])"));
  EXPECT_EQ(changed["time"]["dt"], 1.0 / 120);
  EXPECT_EQ(changed["solver"]["kind"], "nncg");
  EXPECT_EQ(label(knobs, settings.front()), "margin=0.002 solver=nncg step=0.016666666666666666");
}

TEST(Knob, OwnValuesAreThoseOfTheFileOrTheDefaults) {
  const json document = json::parse(R"({
    "format": 1, "meta": {"name": "one", "about": "one", "source": "made"}, "time": {"dt": 0.0166667, "substeps": 4},
    "world": {"bounds": {"min": [-9, -9, -9], "max": [9, 9, 9]}},
    "shapes": [{"name": "ball", "type": "sphere", "radius": 0.5}],
    "bodies": [{"shape": "ball", "mass": 2, "position": [0, 0, 0]}, {"shape": "ball", "mass": 1, "position": [3, 0, 0]}]
  })");
  const scenes::Scene scene = scenes::parse_scene(document.dump(), "one.json");
  const auto own = [&](const std::vector<std::string>& texts) {
    std::vector<Knob> knobs;
    for (const std::string& text : texts) knobs.push_back(parse_knob(text));
    return is_own(document, scene, knobs, grid(knobs).front());
  };
  for (const char* text : {"substeps=4", "/time/substeps=4", "dt=1/60", "iterations=10", "warmstart=true", "residual=0",
                           "friction_directions=two", "precision=single", "solver=sequential_impulses",
                           "bounces=in_solver", "erp=0.2", "/bodies/0/mass=2", "/bodies/*/shape=ball"})
    EXPECT_TRUE(own({text})) << text;
  for (const char* text :
       {"substeps=1", "dt=1/59", "iterations=5", "warmstart=false", "friction_directions=one", "precision=double",
        "solver=dantzig", "bounces=on_contact", "/bodies/0/friction=0.5", "/bodies/*/mass=2"})
    EXPECT_FALSE(own({text})) << text;
  EXPECT_TRUE(own({"substeps=4", "iterations=10"}));
  EXPECT_FALSE(own({"substeps=4", "iterations=11"}));
}

TEST(Knob, NullTakesAKeyAway) {
  Knob knob = parse_knob("/bodies/*/ccd=1");
  knob.values = {nullptr};
  knob.labels = {"automatic"};
  EXPECT_EQ(with(json::parse(R"({"bodies": [{"ccd": 1}, {}]})"), {knob}, {nullptr}),
            json::parse(R"({"bodies": [{}, {}]})"));
  EXPECT_EQ(label({knob}, {nullptr}), "/bodies/*/ccd=automatic");
}

}  // namespace
}  // namespace boxstream::accuracy_test
