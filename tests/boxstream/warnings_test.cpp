// SPDX-License-Identifier: MIT
// What is said of a scene before it runs, and of a run at its end.
#include "boxstream/advice/warnings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_json/shipped_scenes.hpp"
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

// One cube rests 5 mm deep in the floor, one flies out of the world, and one hangs from what is too heavy for its joint.
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
  EXPECT_NE(run.out.find("\npenetration   0.005 m at the deepest in step 1, 0 (sunk) and 1; up to 0.5 % of the thinner"),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("\njoint gap     "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find(", 3 (link) and the world\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\ngained        "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\nlost          1 bodies"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("boxstream: unsound: a joint is "), std::string::npos) << run.err;
  const json vitals = json::parse(directory.read("out.json"))["worlds"][0]["vitals"];
  EXPECT_NEAR(vitals.at("deepest_m"), 0.005, 1e-5);
  EXPECT_EQ(vitals.at("when_deepest"), json({{"step", 1}, {"objects", {0, 1}}}));
  EXPECT_GT(vitals.at("joint_gap_m"), 0.1);
  EXPECT_EQ(vitals.at("when_widest").at("objects"), json({3, -1}));
  EXPECT_EQ(vitals.at("bodies_lost"), 1);
}

TEST(Vitals, OfWhatTouchesNothingAreToldToo) {
  const ScratchDirectory directory;
  const json scene = scene_of({{{"shape", "cube"}, {"mass", 1}, {"position", {0, 3, 0}}}});
  const Outcome run = run_tool({"simulate", directory.write("scene.json", scene.dump()), "--strict"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("\npenetration   0 m at the deepest\njoint gap     0 m at the widest\n"
                         "gained        0 J beyond work, in 0 steps\nlost          0 bodies"),
            std::string::npos)
      << run.out;
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
