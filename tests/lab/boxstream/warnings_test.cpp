// SPDX-License-Identifier: MIT
// What is said of a scene before it runs, and of a run at its end.
#include "boxstream/advice/warnings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "formats/scene_json/load_scene.hpp"
#include "process.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

using nlohmann::json;

/// The lines of standard error that are warnings of the scene.
std::vector<std::string> warned(const std::string& err) {
  std::vector<std::string> lines;
  std::istringstream in(err);
  const std::string name = "boxstream: ";
  for (std::string line; std::getline(in, line);)
    for (const char* const kind : {"overlap: ", "wrong: ", "hard: ", "coarse: "})
      if (line.starts_with(name + kind)) lines.push_back(line.substr(name.size()));
  return lines;
}

const char* const warned_of[] = {"hard/ball_and_chain", "hard/bounce_energy", "hard/overlap_recovery",
                                 "effects/conveyors",   "hard/far_100km",     "hard/thin_boxes_on_mesh"};

TEST(Warnings, AreTheSameOfExplainAndSimulate) {
  for (const char* const name : warned_of) {
    const tool::Warnings known = tool::warnings_of(scenes::load_scene(scenes::shipped(std::string(name) + ".json")));
    EXPECT_FALSE(known.lines().empty()) << name;
    EXPECT_EQ(warned(run_tool({"simulate", name, "--steps", "1"}).err), known.lines()) << name;
    const std::string explained = run_tool({"explain", name}).out;
    for (const tool::HardCase& each : known.hard)
      EXPECT_NE(explained.find("\nhard     " + each.what + ".\n"), std::string::npos) << explained;
    for (const tool::CoarseStep& each : known.coarse)
      EXPECT_NE(explained.find("\ncoarse   " + each.what + ".\n"), std::string::npos) << explained;
    if (!known.overlap.empty()) {
      EXPECT_NE(explained.find("\noverlap  " + known.overlap), std::string::npos) << explained;
    }
  }
}

TEST(Warnings, EndAStrictRunBeforeItsFirstStep) {
  const ScratchDirectory directory;
  for (const char* const name : warned_of) {
    const Outcome run = run_tool({"simulate", name, "--strict", "--json", directory.file("a.json")});
    EXPECT_EQ(run.exit_code, 1) << name;
    EXPECT_FALSE(warned(run.err).empty()) << name;
    EXPECT_NE(run.err.find("--strict: "), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(directory.count(), 0U) << name;
  }
  const Outcome calm = run_tool({"simulate", "hard/ball_and_chain_stable", "--strict", "--steps", "5"});
  EXPECT_EQ(calm.exit_code, 0) << calm.err;
}

json scene_of(const json& bodies) {
  return {{"format", 1},
          {"meta", {{"name", "bodies"}, {"about", "Some bodies."}}},
          {"time", {{"dt", 0.01}, {"steps", 100}}},
          {"world", {{"gravity", {0, -10, 0}}, {"bounds", {{"min", {-9, -9, -9}}, {"max", {9, 9, 9}}}}}},
          {"shapes",
           {{{"name", "cube"}, {"type", "box"}, {"half_extents", {0.5, 0.5, 0.5}}},
            {{"name", "floor"}, {"type", "box"}, {"half_extents", {3, 1, 3}}}}},
          {"bodies", bodies}};
}

json warnings_of(const ScratchDirectory& directory, const json& scene) {
  const Outcome run = run_tool({"explain", directory.write("w.json", scene.dump()), "--json", "-"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return json::parse(run.out);
}

bool says(const json& list, const std::string& word) {
  return list.dump().find(word) != std::string::npos;
}

// Its arm starts 23 degrees below what the hinge allows.
TEST(Warnings, NameAJointThatStartsOutOfItsLimits) {
  const ScratchDirectory directory;
  json scene = scene_of({{{"name", "arm"}, {"shape", "cube"}, {"mass", 1}, {"position", {1, 3, 0}}}});
  scene["joints"] = {
      {{"type", "hinge"}, {"a", "arm"}, {"pivot", {0, 3, 0}}, {"axis", {0, 0, 1}}, {"limits", {23, 50}}}};
  EXPECT_TRUE(says(warnings_of(directory, scene)["warnings"], "23 degrees out of its limits"));
  scene["joints"][0]["limits"] = {-5, 50};
  EXPECT_FALSE(says(warnings_of(directory, scene)["warnings"], "limits"));
  scene["joints"] = {
      {{"type", "slider"}, {"a", "arm"}, {"pivot", {0, 3, 0}}, {"axis", {1, 0, 0}}, {"limits", {-2, -0.5}}}};
  EXPECT_TRUE(says(warnings_of(directory, scene)["warnings"], "0.5 m out of its limits"));
}

TEST(Warnings, NameAMotorThatTurnsTooFarInAStep) {
  const ScratchDirectory directory;
  json scene = scene_of({{{"name", "arm"}, {"shape", "cube"}, {"mass", 1}, {"position", {1, 3, 0}}}});
  scene["joints"] = {{{"type", "hinge"},
                      {"a", "arm"},
                      {"pivot", {0, 3, 0}},
                      {"axis", {0, 1, 0}},
                      {"motor", {{"speed", 20}, {"max_force", 1000}}}}};
  EXPECT_TRUE(says(warnings_of(directory, scene)["coarse_steps"], "a motor turns a body by 11 degrees in a step"));
  scene["time"]["substeps"] = 2;
  EXPECT_TRUE(says(warnings_of(directory, scene)["coarse_steps"], "3 substeps"));
  scene["time"]["substeps"] = 3;
  EXPECT_FALSE(says(warnings_of(directory, scene)["coarse_steps"], "motor"));
}

// A cube whose steps of 0.6 m end in the floor or, from half a metre higher, at its surface.
TEST(Warnings, NameWhatFliesDeepIntoAFixedBox) {
  const ScratchDirectory directory;
  json scene = scene_of(
      {{{"name", "fast"}, {"shape", "cube"}, {"mass", 1}, {"position", {0, 2.95, 0}}, {"velocity", {0, -60, 0}}},
       {{"shape", "floor"}, {"type", "static"}, {"position", {0, -1, 0}}}});
  EXPECT_TRUE(
      says(warnings_of(directory, scene)["coarse_steps"],
           "body 0 (\\\"fast\\\") moves by 0.61 m in the step in which it meets body 1: it comes 0.56 m deep, 56 %"));
  scene["time"]["substeps"] = 2;
  EXPECT_FALSE(says(warnings_of(directory, scene)["coarse_steps"], "deep"));
  scene["time"]["substeps"] = 1;
  scene["bodies"][0]["position"] = {0, 3.5, 0};
  EXPECT_FALSE(says(warnings_of(directory, scene)["coarse_steps"], "deep"));
  // Something else that moves is hit first.
  scene["bodies"][0]["position"] = {0, 2.95, 0};
  scene["bodies"].push_back({{"shape", "cube"}, {"mass", 1}, {"position", {0, 0.5, 0}}});
  EXPECT_FALSE(says(warnings_of(directory, scene)["coarse_steps"], "deep"));
  // Swept by a ball of half its size, it comes half as deep as it is thick into what is thinner than that.
  scene["bodies"].erase(2);
  scene["bodies"][0]["velocity"] = {0, -300, 0};
  scene["shapes"][1]["half_extents"] = {3, 0.1, 3};
  EXPECT_TRUE(says(warnings_of(directory, scene)["coarse_steps"], "radius\\\": 0.45"));
}

// After 79 m a cube moves by 2 m in a step. With damping it never moves by more than 0.33 m.
TEST(Warnings, OfLandingsReckonWithDamping) {
  const ScratchDirectory directory;
  json scene = scene_of({{{"shape", "cube"}, {"mass", 1}, {"ccd", false}, {"position", {0, 79.7, 0}}},
                         {{"shape", "floor"}, {"type", "static"}, {"position", {0, -1, 0}}}});
  scene["time"] = {{"dt", 0.05}, {"steps", 400}};
  scene["world"]["bounds"] = {{"min", {-90, -90, -90}}, {"max", {90, 90, 90}}};
  EXPECT_TRUE(says(warnings_of(directory, scene)["coarse_steps"],
                   "body 0 moves by 2 m in the step in which it meets body 1: it comes 1.8 m deep, 180 %"));
  scene["bodies"][0]["linear_damping"] = 0.8;
  EXPECT_FALSE(says(warnings_of(directory, scene)["coarse_steps"], "deep"));
  // 0.1^0.05 of 40 m/s is left of it in the step in which it lands.
  scene["bodies"][0]["linear_damping"] = 0.9;
  scene["bodies"][0]["position"] = {0, 0.7, 0};
  scene["bodies"][0]["velocity"] = {0, -40, 0};
  EXPECT_TRUE(says(warnings_of(directory, scene)["coarse_steps"], "body 0 moves by 1.8 m in the step"));
}

TEST(Warnings, OfThrowsAreOfWhatGravityAloneSlowsDown) {
  const ScratchDirectory directory;
  json scene =
      scene_of({{{"shape", "cube"}, {"mass", 1}, {"position", {0, 0, 0}}, {"velocity", {0, 4, 0}}, {"sleep", false}}});
  EXPECT_TRUE(says(warnings_of(directory, scene)["coarse_steps"],
                   "a body is thrown up at 4 m/s: it rises 2.5 % less high, by half of what it moves in a step"));
  scene["bodies"][0]["linear_damping"] = 0.3;
  EXPECT_FALSE(says(warnings_of(directory, scene)["coarse_steps"], "thrown"));
  scene["bodies"][0]["linear_damping"] = 0;
  scene["fields"] = {{{"type", "drag"}, {"linear", 0.01}}};
  EXPECT_FALSE(says(warnings_of(directory, scene)["coarse_steps"], "thrown"));
}

TEST(Warnings, NameWhatIsPutToRestThoughItWouldFlyOn) {
  const ScratchDirectory directory;
  json scene = scene_of(
      {{{"name", "slow"}, {"shape", "cube"}, {"mass", 1}, {"position", {0, 0, 0}}, {"velocity", {0.1, 0, 0}}}});
  scene["world"]["gravity"] = {0, 0, 0};
  scene["time"]["steps"] = 300;
  EXPECT_TRUE(says(warnings_of(directory, scene)["warnings"], "put to rest after 2 s"));
  scene["bodies"][0]["sleep"] = false;
  EXPECT_EQ(warnings_of(directory, scene)["warnings"], json::array());
  scene["bodies"][0]["sleep"] = true;
  scene["bodies"][0]["velocity"] = {0.9, 0, 0};
  EXPECT_EQ(warnings_of(directory, scene)["warnings"], json::array());
}

TEST(Warnings, NameWhatIsPutToRestInTheMiddleOfItsMotion) {
  const ScratchDirectory directory;
  const auto warnings = [&](const json& scene) { return warnings_of(directory, scene)["warnings"]; };
  const std::string rest = "which is slow enough to be put to rest after 2 s";
  // A fall of 0.35 m/s^2 comes to 0.7 m/s in 2 s. Steps of the warm-up count.
  json scene = scene_of({{{"shape", "cube"}, {"mass", 3}, {"position", {0, 5, 0}}}});
  scene["world"]["gravity"] = {0, -0.35, 0};
  scene["time"] = {{"dt", 0.01}, {"steps", 150}, {"warmup_steps", 100}};
  EXPECT_TRUE(says(warnings(scene), "body 0 comes to 0.7 m/s and 0 rad/s at most, " + rest));
  scene["world"]["gravity"] = {0, -0.45, 0};
  EXPECT_EQ(warnings(scene), json::array());
  // In oil it sinks at 3 * 10 / 60 m/s, however it began.
  scene["world"]["gravity"] = {0, -10, 0};
  scene["fields"] = {{{"type", "drag"}, {"linear", 60}}};
  EXPECT_TRUE(says(warnings(scene), "body 0 comes to 0.5 m/s"));
  scene["fields"][0]["linear"] = 30;
  EXPECT_EQ(warnings(scene), json::array());
  scene["fields"][0]["linear"] = 60;
  scene["bodies"][1] = {{"shape", "floor"}, {"type", "static"}, {"position", {0, 3, 0}}};
  EXPECT_EQ(warnings(scene), json::array()) << "it may lie there";
  scene["bodies"].erase(1);
  // A pendulum of 2 m that starts 0.2 rad from the vertical: 2 * sqrt(10 * 2) * sin(0.1) m/s.
  scene.erase("fields");
  scene["bodies"][0]["name"] = "bob";
  scene["bodies"][0]["position"] = {2 * std::sin(0.2), 6 - 2 * std::cos(0.2), 0};
  scene["joints"] = {{{"type", "hinge"}, {"a", "bob"}, {"pivot", {0, 6, 0}}, {"axis", {0, 0, 1}}}};
  EXPECT_EQ(warnings(scene), json::array()) << "0.89 m/s";
  scene["bodies"][0]["position"] = {2 * std::sin(0.1), 6 - 2 * std::cos(0.1), 0};
  EXPECT_TRUE(says(warnings(scene), "comes to 0.45 m/s and 0.22 rad/s at most, " + rest));
  scene["bodies"][0]["position"] = {0, 4, 0};
  EXPECT_EQ(warnings(scene), json::array()) << "it hangs still";
  scene["bodies"][0]["spin"] = {0, 0, 0.3};
  EXPECT_TRUE(says(warnings(scene), "comes to 0.6 m/s and 0.3 rad/s at most, " + rest));
  // About its centre it turns at what it has.
  scene["bodies"][0]["position"] = {0, 6, 0};
  EXPECT_TRUE(says(warnings(scene), "comes to 0 m/s and 0.3 rad/s at most, " + rest));
  scene["bodies"][0]["spin"] = {0, 0, 30};
  EXPECT_EQ(warnings(scene), json::array());
}

TEST(Warnings, NameWhatSleepsWhereGravityTurnsSlowly) {
  const ScratchDirectory directory;
  json scene = scene_of({{{"shape", "cube"}, {"mass", 3}, {"position", {0, 0.5, 0}}},
                         {{"shape", "floor"}, {"type", "static"}, {"position", {0, -1, 0}}}});
  scene["time"]["steps"] = 400;
  scene["world"]["gravity"] = {{"script", "tumble"}, {"strength", 10}, {"degrees_per_second", 15}};
  EXPECT_TRUE(says(warnings_of(directory, scene)["warnings"], "gravity, which turns, does not wake it"));
  scene["world"]["gravity"]["degrees_per_second"] = 25;
  EXPECT_EQ(warnings_of(directory, scene)["warnings"], json::array());
}

/// A rod of 4 m, 30 degrees from upright.
json rod(const json& position) {
  return {{"name", "rod"},
          {"shape", "rod"},
          {"mass", 5},
          {"position", position},
          {"rotation", {{"axis", {0, 0, 1}}, {"degrees", 30}}}};
}

TEST(Warnings, OfALadderAreOfWhatLeansOnSomething) {
  const ScratchDirectory directory;
  json scene = scene_of({rod({0, 1.8, 0}), {{"shape", "floor"}, {"type", "static"}, {"position", {0, -1, 0}}}});
  scene["shapes"].push_back({{"name", "rod"}, {"type", "box"}, {"half_extents", {0.05, 2, 0.2}}});
  EXPECT_FALSE(says(warnings_of(directory, scene)["coarse_steps"], "leans"));
  EXPECT_TRUE(says(warnings_of(directory, scene)["coarse_steps"], "stands on an edge"));
  scene["bodies"].push_back({{"shape", "floor"}, {"type", "static"}, {"position", {-4.05, 3, 0}}});
  EXPECT_TRUE(says(warnings_of(directory, scene)["coarse_steps"], "leans"));
  scene["bodies"][0] = rod({5, 4, 0});
  EXPECT_FALSE(says(warnings_of(directory, scene)["coarse_steps"], "edge"));
}

// Dominoes of one kind in long steps: no mass differs from another.
TEST(Warnings, OfMassesAreOfMassesThatDiffer) {
  const ScratchDirectory directory;
  json scene = scene_of({{{"shape", "cube"}, {"mass", 1}, {"position", {0, 0.5, 0}}},
                         {{"shape", "cube"}, {"mass", 1}, {"position", {1.2, 1.6, 0}}},
                         {{"shape", "floor"}, {"type", "static"}, {"position", {0, -1, 0}}}});
  scene["time"]["dt"] = 0.1;
  EXPECT_EQ(warnings_of(directory, scene)["hard_cases"], json::array());
  scene["bodies"][1]["mass"] = 300;
  EXPECT_TRUE(says(warnings_of(directory, scene)["hard_cases"], "bodies of 1 to 300 kg: a heavy one (1)"));
  scene["bodies"][1]["position"] = {3.9, 1.6, 0};
  EXPECT_EQ(warnings_of(directory, scene)["hard_cases"], json::array());
}

// A chain that ten iterations do not hold: what does is found by running it.
TEST(Tried, SettingsAreThoseOfTheSceneItself) {
  const ScratchDirectory directory;
  json scene = scene_of({{{"name", "l0"}, {"shape", "cube"}, {"mass", 1}, {"position", {0, -0.5, 0}}},
                         {{"name", "l1"}, {"shape", "cube"}, {"mass", 1}, {"position", {0, -1.5, 0}}},
                         {{"name", "l2"}, {"shape", "cube"}, {"mass", 1}, {"position", {0, -2.5, 0}}},
                         {{"name", "end"}, {"shape", "cube"}, {"mass", 3000}, {"position", {0, -3.5, 0}}}});
  scene["joints"] = {{{"type", "ball"}, {"a", "l0"}, {"pivot", {0, 0, 0}}},
                     {{"type", "ball"}, {"a", "l1"}, {"b", "l0"}, {"pivot", {0, -1, 0}}},
                     {{"type", "ball"}, {"a", "l2"}, {"b", "l1"}, {"pivot", {0, -2, 0}}},
                     {{"type", "ball"}, {"a", "end"}, {"b", "l2"}, {"pivot", {0, -3, 0}}}};
  scene["time"] = {{"dt", 1.0 / 60}, {"steps", 120}};
  const std::string file = directory.write("chain.json", scene.dump());
  const Outcome run = run_tool({"explain", file, "--try", "--budget", "10", "--json", directory.file("out.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json tried = json::parse(directory.read("out.json"))["tried"];
  EXPECT_EQ(tried["as_it_is"], false) << tried;
  ASSERT_TRUE(tried["advice"].is_string()) << tried;
  EXPECT_NE(run.out.find("\n         As it is: not sound, it "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\n         The cheapest sound one: " + tried["advice"].get<std::string>()), std::string::npos)
      << run.out;
  EXPECT_EQ(tried["price"].size(), 3U);
  EXPECT_EQ(run_tool({"explain", file, "--try", "--steps", "5"}).exit_code, 2);
}

// One cube rests 5 mm deep in the floor, one flies out of the world, and one hangs from what is too heavy for its
// joint.
TEST(Vitals, AreToldAtTheEndOfARun) {
  const ScratchDirectory directory;
  json scene = scene_of({{{"name", "sunk"}, {"shape", "cube"}, {"mass", 1}, {"position", {0, 0.495, 0}}},
                         {{"shape", "floor"}, {"type", "static"}, {"position", {0, -1, 0}}},
                         {{"shape", "cube"}, {"mass", 1}, {"position", {7, 0, 0}}, {"velocity", {20, 0, 0}}},
                         {{"name", "link"}, {"shape", "cube"}, {"mass", 1}, {"position", {-7, 5, 0}}},
                         {{"name", "load"}, {"shape", "cube"}, {"mass", 5000}, {"position", {-7, 3.5, 0}}}});
  scene["joints"] = {{{"type", "ball"}, {"a", "link"}, {"pivot", {-7, 5.75, 0}}},
                     {{"type", "ball"}, {"a", "link"}, {"b", "load"}, {"pivot", {-7, 4.25, 0}}}};
  const std::string file = directory.write("scene.json", scene.dump());
  const Outcome run = run_tool({"simulate", file, "--json", directory.file("out.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(
      run.out.find("\npenetration   0.005 m at the deepest in step 1, 0 (sunk) and 1; up to 0.5 % of the thinner"),
      std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("\njoint gap     "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find(", 3 (link) and 4 (load)\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\nlost          1 bodies"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("boxstream: unsound: a joint is "), std::string::npos) << run.err;
  const json vitals = json::parse(directory.read("out.json"))["worlds"][0]["vitals"];
  EXPECT_NEAR(vitals.at("deepest_m"), 0.005, 1e-5);
  EXPECT_EQ(vitals.at("when_deepest"), json({{"step", 1}, {"objects", {0, 1}}}));
  EXPECT_GT(vitals.at("joint_gap_m"), 0.1);
  EXPECT_EQ(vitals.at("when_widest").at("objects"), json({3, 4}));
  EXPECT_EQ(vitals.at("bodies_lost"), 1);
}

TEST(Vitals, OfWhatTouchesNothingAreToldToo) {
  const ScratchDirectory directory;
  const json scene = scene_of({{{"shape", "cube"}, {"mass", 1}, {"position", {0, 3, 0}}}});
  const Outcome run = run_tool({"simulate", directory.write("scene.json", scene.dump()), "--strict"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("\npenetration   0 m at the deepest\njoint gap     0 m at the widest\ngained        "),
            std::string::npos)
      << run.out;
  // What rounding makes of a free fall is a gain in all, and none in a step.
  EXPECT_NE(run.out.find(" J beyond work in all, at most 0 J in a step; in 0 steps\nlost          0 bodies"),
            std::string::npos)
      << run.out;
}

TEST(OldWords, OfASceneAreNamedInOneLine) {
  const ScratchDirectory directory;
  json scene = scene_of({{{"shape", "cube"}, {"mass", 1}, {"position", {0, 3, 0}}}});
  scene["fields"] = {{{"type", "kicks"}, {"share", 0.5}, {"speed", 1}}};
  scene["effects"] = {{"forbid", {"apart"}}};
  const std::string file = directory.write("scene.json", scene.dump());
  const std::string note =
      "boxstream: note: " + file + ": \"kicks\" is \"impulses\" now, \"apart\" is \"exclusions\" now\n";
  for (const std::vector<std::string>& command : {std::vector<std::string>{"simulate", file, "--steps", "2"},
                                                  {"explain", file},
                                                  {"accuracy", file, "--knob", "substeps=1,2", "--steps", "2"}}) {
    const Outcome run = run_tool(command);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const std::size_t at = run.err.find(note);
    ASSERT_NE(at, std::string::npos) << run.err;
    EXPECT_EQ(run.err.find("note: ", at + note.size()), std::string::npos) << run.err;
  }
  EXPECT_NE(run_tool({"explain", file}).out.find("\nimpulses "), std::string::npos);
}

// What gains energy in its run was not to be seen before it.
TEST(Vitals, OfARunThatGoesWrongAreAFailureWhereItIsStrict) {
  const ScratchDirectory directory;
  json scene = scene_of({{{"shape", "cube"}, {"mass", 1}, {"position", {0, 0.495, 0}}},
                         {{"shape", "floor"}, {"type", "static"}, {"position", {0, -1, 0}}}});
  scene["solver"] = {{"split_impulse", false}, {"erp", 1}, {"contact_erp", 1}};
  scene["time"]["dt"] = 0.0005;
  const std::string file = directory.write("scene.json", scene.dump());
  EXPECT_EQ(run_tool({"simulate", file}).exit_code, 0);
  const Outcome run = run_tool({"simulate", file, "--strict", "--json", directory.file("out.json")});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_TRUE(warned(run.err).empty()) << run.err;
  EXPECT_NE(run.err.find("--strict: the run is not sound: "), std::string::npos) << run.err;
  EXPECT_EQ(directory.count(), 2U);
}

}  // namespace
}  // namespace boxstream::tool_test
