// SPDX-License-Identifier: MIT
// Worlds of Bullet in double precision, which the tool has in a program beside it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "formats/scene_json/load_scene.hpp"
#include "process.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A ball glides at 3 cm/s for ten seconds, `far` from the origin.
json glider(double far) {
  return {
      {"format", 1},
      {"meta", {{"name", "glider"}, {"about", "A ball glides."}}},
      {"time", {{"dt", 0.02}, {"steps", 500}}},
      {"world", {{"gravity", {0, 0, 0}}, {"bounds", {{"min", {-1e5, -9, -9}}, {"max", {1e5, 9, 9}}}}}},
      {"shapes", {{{"name", "ball"}, {"type", "sphere"}, {"radius", 0.25}}}},
      {"bodies",
       {{{"shape", "ball"}, {"mass", 2}, {"position", {far, 0, 0}}, {"velocity", {0.03, 0, 0}}, {"sleep", false}}}}};
}

std::string write_scene(const ScratchDirectory& directory, const json& scene) {
  std::ofstream(directory.file("scene.json")) << scene;
  return directory.file("scene.json");
}

/// How far the ball came, by the last row of a table of states.
double way(const std::string& states, double from) {
  std::ifstream in(states);
  std::string line, last;
  while (std::getline(in, line)) last = line;
  std::istringstream cells(last);
  for (int i = 0; i < 4; ++i) std::getline(cells, line, ',');
  return std::stod(line) - from;
}

TEST(Precision, IsSingleOrDouble) {
  const Outcome run = run_tool({"simulate", "pile", "--precision", "half"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("--precision: unknown precision"), std::string::npos) << run.err;
}

TEST(Precision, OfASceneIsExplainedAndOverruled) {
  const ScratchDirectory directory;
  json scene = glider(0);
  scene["solver"]["precision"] = "double";
  const std::string file = write_scene(directory, scene);
  EXPECT_EQ(run_tool({"explain", file}).exit_code, 0);
  // The command line has the last word.
  EXPECT_EQ(run_tool({"simulate", file, "--precision", "single"}).exit_code, 0);
}

TEST(Precision, CoarsePlacesAreWarnedOf) {
  const ScratchDirectory directory;
  const auto told = [&](const json& scene) {
    return json::parse(run_tool({"explain", write_scene(directory, scene), "--json", "-"}).out)["coarse_steps"];
  };
  EXPECT_TRUE(told(glider(0)).empty());
  EXPECT_TRUE(told(glider(100)).empty());
  const json far = told(glider(70'000));
  ASSERT_EQ(far.size(), 1u);
  EXPECT_NE(far[0]["what"].get<std::string>().find("places apart by 0.0078 m, and moves by 0.0006 m in a step"),
            std::string::npos)
      << far;
  EXPECT_NE(far[0]["advice"].get<std::string>().find(R"("precision": "double")"), std::string::npos) << far;

  // A small body at rest, at a place where a large one is well.
  json small = glider(3'000);
  small["bodies"][0]["velocity"] = {0, 0, 0};
  EXPECT_TRUE(told(small).empty());
  small["shapes"][0]["radius"] = 0.002;
  EXPECT_NE(told(small)[0]["what"].get<std::string>().find("0.004 m thick"), std::string::npos);
  small["solver"]["precision"] = "double";
  EXPECT_TRUE(told(small).empty());
}

TEST(Precision, WithoutTheOtherProgramALineSaysSo) {
  const ScratchDirectory directory;
  const std::string alone = directory.file("boxstream");
  fs::copy_file(tool_program(), alone);
  const Outcome run = run_program(alone, {"simulate", write_scene(directory, glider(0)), "--precision", "double"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("boxstream-double, the part of this tool that has worlds of double precision"),
            std::string::npos)
      << run.err;

  const Outcome accuracy =
      run_program(alone, {"accuracy", directory.file("scene.json"), "--knob", "precision=single,double"});
  EXPECT_EQ(accuracy.exit_code, 2);
  EXPECT_NE(accuracy.err.find("/solver/precision: boxstream-double, the part of this tool"), std::string::npos)
      << accuracy.err;
  // Advice does without.
  const Outcome advice = run_program(
      alone, {"accuracy", write_scene(directory, glider(70'000)), "--advise", "--budget", "2", "--json", "-"});
  ASSERT_EQ(advice.exit_code, 0) << advice.err;
  EXPECT_EQ(advice.out.find("precision=double"), std::string::npos) << advice.out;
}

TEST(Precision, AsAKnobIsSingleOrDouble) {
  const ScratchDirectory directory;
  const std::string file = write_scene(directory, glider(0));
  for (const char* const knob : {"precision=half", "precision=2"}) {
    const Outcome run = run_tool({"accuracy", file, "--knob", knob});
    EXPECT_EQ(run.exit_code, 2) << knob;
    EXPECT_NE(run.err.find("/solver/precision: "), std::string::npos) << run.err;
  }
}

#ifdef BOXSTREAM_WITH_DOUBLES

TEST(Precision, AccuracyHasBothInOneTable) {
  const ScratchDirectory directory;
  const std::string file = write_scene(directory, glider(70'000)), answer = directory.file("answer.json");
  const Outcome run = run_tool({"accuracy", file, "--knob", "precision=single,double", "--knob", "substeps=1,2",
                                "--metric", "trajectory", "--repeats", "2", "--json", answer});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("precision=single substeps=2"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("precision=double substeps=2"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("dantzig, double precision"), std::string::npos) << run.out;
  const json settings = json::parse(std::ifstream(answer)).at("settings");
  ASSERT_EQ(settings.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const double error = settings[i].at("measures").at("trajectory").at("worst");
    const bool is_double = settings[i].at("knobs").at("precision") == "double";
    EXPECT_EQ(is_double, i >= 2);
    // It moves by less in a step than floats are apart there, and the reference is kept in floats.
    EXPECT_EQ(error > 0.1, !is_double) << i << ": " << error;
    EXPECT_EQ(settings[i].contains("unsound"), !is_double) << i;
    EXPECT_GT(settings[i].at("ms_per_s").at("median"), 0) << i;
  }
}

TEST(Precision, DoublesAreAdvisedFarAwayAndNotTriedNearby) {
  const ScratchDirectory directory;
  const auto advice = [&](double far) {
    const Outcome run =
        run_tool({"accuracy", write_scene(directory, glider(far)), "--advise", "--budget", "10", "--json", "-"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return json::parse(run.out).at("advice").get<std::string>();
  };
  EXPECT_NE(advice(70'000).find("precision=double"), std::string::npos);
  EXPECT_EQ(advice(0).find("precision"), std::string::npos);
}

TEST(Precision, PagesThatPlaySettingsAreOfSingleAlone) {
  const ScratchDirectory directory;
  const Outcome run = run_tool({"accuracy", write_scene(directory, glider(0)), "--knob", "precision=single,double",
                                "--view", directory.file("view.html")});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("--view: "), std::string::npos) << run.err;
}

TEST(Precision, DoublesTellFarPlacesApart) {
  constexpr double far = 70'000;
  const ScratchDirectory directory;
  const std::string file = write_scene(directory, glider(far)), states = directory.file("states.csv");
  ASSERT_EQ(run_tool({"simulate", file, "--states", states}).exit_code, 0);
  EXPECT_GT(std::abs(way(states, far) - 0.3), 0.1);
  const Outcome run = run_tool({"simulate", file, "--states", states, "--precision", "double"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NEAR(way(states, far), 0.3, 1e-6);
  EXPECT_EQ(run.err.find("coarse"), std::string::npos) << run.err;

  json scene = glider(far);
  scene["solver"]["precision"] = "double";
  ASSERT_EQ(run_tool({"simulate", write_scene(directory, scene), "--states", states}).exit_code, 0);
  EXPECT_NEAR(way(states, far), 0.3, 1e-6);
}

// Small cubes upon each other, away from where floats tell them apart: pairs are those of the boxes in doubles.
TEST(Precision, PairsAreTheSameOnAllBroadphases) {
  const ScratchDirectory directory;
  json scene = glider(0);
  scene["world"]["gravity"] = {0, -9.81, 0};
  scene["time"]["steps"] = 60;
  scene["shapes"] = json::array({{{"name", "cube"}, {"type", "box"}, {"half_extents", {0.01, 0.01, 0.01}}},
                                 {{"name", "floor"}, {"type", "box"}, {"half_extents", {1, 1, 1}}}});
  scene["bodies"] = json::array({{{"shape", "floor"}, {"type", "static"}, {"position", {80'000, -1, 0}}}});
  for (int i = 0; i < 100; ++i)
    scene["bodies"].push_back(
        {{"shape", "cube"}, {"mass", 0.01}, {"position", {80'000 + 0.021 * (i % 10), 0.011 + 0.03 * (i / 10), 0.0}}});
  scene["checks"] = json::array({{{"metric", "missed_pairs"}, {"op", "=="}, {"value", 0}}});
  const std::string file = write_scene(directory, scene);
  for (const char* const other : {"dbvt", "sap"}) {
    const Outcome run = run_tool({"simulate", file, "--precision", "double", "--compare", other});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("pairs equal"), std::string::npos) << run.out;
  }
}

// Soft bodies, vehicles, characters, joints of all kinds, sensors, files of others.
TEST(Precision, EverySceneRunsInDoubles) {
  for (const char* const name : {"pile", "cloth", "effects/vehicles", "character", "ragdolls", "arm", "effects/wind",
                                 "effects/gyroscopic", "effects/buoyancy", "effects/ccd", "effects/soft_bodies"}) {
    if (!fs::exists(scenes::shipped(std::string(name) + ".json"))) continue;
    const Outcome run = run_tool({"simulate", name, "--precision", "double", "--steps", "20"});
    // Checks of the end are not asked.
    EXPECT_TRUE(run.exit_code == 0 || run.err.find("not evaluated") != std::string::npos) << name << ": " << run.err;
  }
}

TEST(Precision, PicturesPagesAndRecordingsAreWritten) {
  const ScratchDirectory directory;
  const std::string file = write_scene(directory, glider(10));
  const Outcome run = run_tool({"simulate", file, "--precision", "double", "--record", directory.file("a.glb"),
                                "--record", directory.file("a.aabbs"), "--picture", directory.file("a.svg"), "--trace",
                                directory.file("t.json"), "--csv", directory.file("a.csv")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* const name : {"a.glb", "a.aabbs", "a.svg", "t.json", "a.csv"})
    EXPECT_GT(fs::file_size(directory.file(name)), 100u) << name;
}

#endif

}  // namespace
}  // namespace boxstream::tool_test
