// SPDX-License-Identifier: MIT
// What a scene asks to be written and checked, and a table of steps.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "formats/scene_json/load_scene.hpp"
#include "process.hpp"
#include "scenes/energy_gains.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

using nlohmann::json;

/// A ball that falls beside nothing, for half a second.
json falling_ball() {
  return {{"format", 1},
          {"meta", {{"name", "ball"}, {"about", "A ball falls."}}},
          {"time", {{"dt", 0.01}, {"steps", 50}}},
          {"world", {{"gravity", {0, -10, 0}}, {"bounds", {{"min", {-1, -9, -1}}, {"max", {1, 9, 1}}}}}},
          {"shapes", {{{"name", "ball"}, {"type", "sphere"}, {"radius", 0.5}}}},
          {"bodies", {{{"shape", "ball"}, {"mass", 2}, {"position", {0, 4, 0}}}}}};
}

std::string write_scene(const ScratchDirectory& directory, const json& scene) {
  std::ofstream(directory.file("ball.json")) << scene;
  return directory.file("ball.json");
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

TEST(Outputs, OfASceneAreWritten) {
  const ScratchDirectory directory;
  json scene = falling_ball();
  scene["outputs"] = {{"record", {directory.file("a.aabbs"), directory.file("a.bsrec"), directory.file("a.glb")}},
                      {"csv", directory.file("a.csv")},
                      {"trace", directory.file("a.json")}};
  const Outcome run = run_tool({"simulate", write_scene(directory, scene), "--outputs-anywhere"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* const name : {"a.aabbs", "a.bsrec", "a.glb", "a.csv", "a.json"})
    EXPECT_GT(std::filesystem::file_size(directory.file(name)), 100u) << name;
  EXPECT_NE(run.out.find("recording"), std::string::npos) << run.out;

  // Of these there is one in a run, and the command line's word is last.
  std::filesystem::remove(directory.file("a.csv"));
  const Outcome other =
      run_tool({"simulate", directory.file("ball.json"), "--csv", directory.file("b.csv"), "--outputs-anywhere"});
  ASSERT_EQ(other.exit_code, 0) << other.err;
  EXPECT_TRUE(std::filesystem::exists(directory.file("b.csv")));
  EXPECT_FALSE(std::filesystem::exists(directory.file("a.csv")));

  scene["outputs"]["record"] = {"x.bsrec", "y.bsrec"};
  const Outcome two_logs = run_tool({"simulate", write_scene(directory, scene)});
  EXPECT_EQ(two_logs.exit_code, 2);
  EXPECT_EQ(two_logs.err, "boxstream: " + directory.file("ball.json") +
                              ": /outputs/record: x.bsrec and y.bsrec: a run has one log\n");
}

TEST(Outputs, TableFollowsTheBall) {
  const ScratchDirectory directory;
  const Outcome run = run_tool({"simulate", write_scene(directory, falling_ball()), "--csv", directory.file("t.csv")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::ifstream table(directory.file("t.csv"));
  std::string line;
  std::getline(table, line);
  const std::vector<std::string> names = cells(line);
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  std::size_t step = 0;
  while (std::getline(table, line)) {
    ++step;
    const std::vector<std::string> row = cells(line);
    ASSERT_EQ(row.size(), names.size());
    EXPECT_EQ(row[column("step")], std::to_string(step));
    // Bullet changes the velocity first and then moves by it.
    const double t = 0.01 * static_cast<double>(step);
    EXPECT_NEAR(std::stod(row[column("max_speed")]), 10 * t, 1e-4);
    EXPECT_NEAR(std::stod(row[column("momentum")]), 20 * t, 1e-3);
    EXPECT_NEAR(std::stod(row[column("lowest")]), 4 - 5 * t * (t + 0.01), 1e-4);
    EXPECT_NEAR(std::stod(row[column("energy")]), 2 * (5 * 10 * t * t + 10 * (4 - 5 * t * (t + 0.01))), 1e-2);
  }
  EXPECT_EQ(step, 50u);
}

// A ball of 1 m flies at 2 m/s out of a gate that ends 1.5 m further on.
TEST(Outputs, TellWhatEntersAndLeavesASensor) {
  const ScratchDirectory directory;
  const std::string file = directory.file("run.json");
  std::ifstream shipped(scenes::shipped("effects/sensors.json"));
  json scene = json::parse(shipped);
  scene["bodies"][0]["velocity"] = {2, 0, 0};
  const Outcome run = run_tool({"simulate", write_scene(directory, scene), "--events", "-", "--json", file});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::istringstream lines(run.out);
  std::string head, enters, leaves, more;
  std::getline(lines, head);
  std::getline(lines, enters);
  std::getline(lines, leaves);
  EXPECT_EQ(head, "step,seconds,sensor,object,event,name");
  ASSERT_NE(leaves, "");
  EXPECT_EQ(cells(enters)[0], "1");
  EXPECT_TRUE(enters.ends_with(",\"gate\",0,enter,\"ball\"")) << enters;
  EXPECT_TRUE(leaves.ends_with(",\"gate\",0,leave,\"ball\"")) << leaves;
  EXPECT_NEAR(std::stod(cells(leaves)[1]), 0.75, 0.1);
  EXPECT_FALSE(std::getline(lines, more)) << more;

  std::ifstream in(file);
  std::size_t events = 0;
  const json document = json::parse(in);
  for (const json& step : document["worlds"][0]["steps"])
    for (const json& event : step.at("sensor_events")) {
      ++events;
      EXPECT_EQ(
          event,
          json({{"sensor", "gate"}, {"object", 0}, {"event", events == 1 ? "enter" : "leave"}, {"name", "ball"}}));
      EXPECT_EQ(step.at("step"), std::stoi(cells(events == 1 ? enters : leaves)[0]));
    }
  EXPECT_EQ(events, 2u);
}

// The ball of 0.5 m flies half a second: gravity acts, and the floor that it does not reach is not touched.
TEST(Outputs, SayWhatEffectsDid) {
  const ScratchDirectory directory;
  const std::string file = directory.file("run.json");
  std::ifstream shipped(scenes::shipped("effects/contacts.json"));
  json scene = json::parse(shipped);
  scene["bodies"][0]["position"] = {0, 5, 0};
  scene["time"] = {{"dt", 0.01}, {"steps", 50}};
  const Outcome run = run_tool({"simulate", write_scene(directory, scene), "--json", file});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("\nacted         gravity                           50 falling bodies\n"), std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("\nnever acted   contacts, split_impulse\n"), std::string::npos) << run.out;
  std::ifstream in(file);
  EXPECT_EQ(json::parse(in)["worlds"][0]["activity"],
            json({{{"effect", "gravity"}, {"count", 50}, {"unit", "falling bodies"}},
                  {{"effect", "contacts"}, {"count", 0}, {"unit", "contact points"}},
                  {{"effect", "split_impulse"}, {"count", 0}, {"unit", "contact points"}}}));
}

// Nothing acts in it, so that it calls for nothing.
TEST(Outputs, NameTheEffectsThatAreBuilt) {
  const auto built = [](const std::vector<std::string>& options) {
    std::vector<std::string> words{"simulate", "effects/nothing", "--steps", "2", "--json", "-"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome run = run_tool(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const json report = json::parse(run.out);
    std::set<std::string> names;
    for (const json& row : report["worlds"][0]["activity"]) names.insert(row["effect"]);
    return names;
  };
  const auto called = built({}), all = built({"--all-effects"});
  EXPECT_EQ(built({"--only-called"}), called);
  for (const char* const effect : {"gravity", "contacts", "wind"}) {
    EXPECT_FALSE(called.contains(effect)) << effect;
    EXPECT_TRUE(all.contains(effect)) << effect;
  }
  const Outcome both = run_tool({"simulate", "effects/nothing", "--only-called", "--all-effects"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_EQ(both.err, "boxstream: --all-effects excludes --only-called (see boxstream simulate --help)\n");
}

// Two cubes of 1 m, one 0.4 m deep in the floor and thrown out, since nothing moves it apart.
TEST(Outputs, SayWhatBecameOfTheEnergy) {
  const ScratchDirectory directory;
  const std::string file = directory.file("run.json");
  json scene = falling_ball();
  scene["shapes"] = {{{"name", "cube"}, {"type", "box"}, {"half_extents", {0.5, 0.5, 0.5}}},
                     {{"name", "floor"}, {"type", "box"}, {"half_extents", {9, 1, 9}}}};
  scene["bodies"] = {{{"shape", "cube"}, {"mass", 1}, {"position", {5, 0.5, 0}}},
                     {{"name", "sunk"}, {"shape", "cube"}, {"mass", 1}, {"position", {0, 0.1, 0}}},
                     {{"name", "floor"}, {"shape", "floor"}, {"type", "static"}, {"position", {0, -1, 0}}}};
  scene["time"] = {{"dt", 0.0166}, {"steps", 30}};
  scene["solver"] = {{"split_impulse", false}};
  const std::string thrown = write_scene(directory, scene);
  const Outcome run = run_tool({"simulate", thrown, "--json", file});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("\nenergy        6 J at the start, "), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("gained energy that no work explains; most in step 1: "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("most of it body 1 (sunk)"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("one pair of bodies deep in each other at the start; the deepest, 1 (sunk) and 2 (floor), by "
                         "0.4 m: they are thrown apart"),
            std::string::npos)
      << run.err;
  std::ifstream in(file);
  const json energy = json::parse(in)["worlds"][0]["energy"];
  EXPECT_NEAR(energy.at("start_j"), 6, 1e-3);
  EXPECT_GE(energy.at("steps_that_gained"), 1);
  EXPECT_EQ(energy.at("worst_gain").at("body"), 1);
  EXPECT_EQ(energy.at("work_j").size(), 5U);

  scene.erase("solver");
  const std::string moved = write_scene(directory, scene);
  const Outcome calm = run_tool({"simulate", moved});
  EXPECT_EQ(calm.err.find("no work explains"), std::string::npos) << calm.err;
  EXPECT_NE(calm.err.find("moved apart without speed"), std::string::npos) << calm.err;
  EXPECT_NE(calm.out.find("\nwork          apart "), std::string::npos) << calm.out;
  const Outcome explained = run_tool({"explain", moved});
  EXPECT_NE(explained.out.find("\noverlap  one pair of bodies deep in each other at the start"), std::string::npos)
      << explained.out;
}

TEST(Outputs, WarnOfEveryShippedSceneThatGainsEnergy) {
  for (const scenes_test::GainingScene& gaining : scenes_test::gaining_scenes) {
    // Their checks may fail, too: they are hard.
    const Outcome run = run_tool({"simulate", scenes::shipped(gaining.name + ".json")});
    EXPECT_NE(run.err.find(" steps gained energy that no work explains; most in step "), std::string::npos)
        << gaining.name << run.err;
  }
}

std::vector<std::string> effects_of(const std::vector<std::string>& arguments) {
  std::vector<std::string> on;
  const Outcome run = run_tool(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const json document = json::parse(run.out);
  for (const json& row : document.at("effects"))
    if (row.at("on") == true) on.push_back(row.at("effect"));
  return on;
}

TEST(Explain, SaysWhatWouldRun) {
  const ScratchDirectory directory;
  json scene = falling_ball();
  scene["broadphase"] = {{"threads", 2}};
  scene["bodies"] = json::array();
  scene["generators"] = {{{"type", "scatter"},
                          {"count", 3000},
                          {"origin", {0, 0, 0}},
                          {"size", {1, 1, 1}},
                          {"mix", {{{"shape", "ball"}, {"mass", 1}}}}}};
  const std::string file = write_scene(directory, scene);
  using Names = std::vector<std::string>;
  EXPECT_EQ(effects_of({"explain", file, "--json", "-"}),
            (Names{"gravity", "contacts", "friction", "split_impulse", "ccd_on_demand"}));
  // Two seconds are not enough to fall asleep in, three are; more bodies are worth a second thread.
  EXPECT_EQ(effects_of({"explain", file, "--json", "-", "--steps", "300"}),
            (Names{"gravity", "contacts", "friction", "split_impulse", "sleeping", "ccd_on_demand"}));
  EXPECT_EQ(effects_of({"explain", file, "--json", "-", "--scale", "2"}),
            (Names{"gravity", "contacts", "friction", "split_impulse", "threads", "ccd_on_demand"}));

  const Outcome text = run_tool({"explain", file});
  EXPECT_NE(text.out.find("/generators/0: a dynamic body that can meet another"), std::string::npos) << text.out;
  scene["effects"] = {{"forbid", {"friction"}}};
  const Outcome forbidden = run_tool({"explain", write_scene(directory, scene)});
  EXPECT_EQ(forbidden.exit_code, 2);
  EXPECT_EQ(forbidden.err,
            "boxstream: " + file + ": /effects/forbid/0: \"friction\" is called for by /generators/0 (friction 0.5)\n");
}

TEST(Checks, DecideTheExitCode) {
  const ScratchDirectory directory;
  json scene = falling_ball();
  scene["checks"] = {{{"metric", "max_speed"}, {"op", "<="}, {"value", 5.001}, {"at", "always"}},
                     {{"metric", "lowest"}, {"op", ">"}, {"value", 2}, {"at", "end"}},
                     {{"metric", "missed_pairs"}, {"op", "=="}, {"value", 0}, {"at", 10}}};
  const Outcome good = run_tool({"simulate", write_scene(directory, scene)});
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_NE(good.out.find("passed"), std::string::npos) << good.out;

  scene["checks"][0]["value"] = 3;
  const Outcome fast = run_tool({"simulate", write_scene(directory, scene)});
  EXPECT_EQ(fast.exit_code, 1);
  EXPECT_NE(fast.err.find("check failed on boxstream: max_speed <= 3, always (FAILED: 3.1 after step 31)"),
            std::string::npos)
      << fast.err;

  // A run that ends before a check has had its turn does not pass it.
  scene["checks"][0]["value"] = 6;
  const Outcome brief = run_tool({"simulate", write_scene(directory, scene), "--steps", "5"});
  EXPECT_EQ(brief.exit_code, 1);
  EXPECT_NE(brief.err.find("missed_pairs == 0, after step 10 (not evaluated"), std::string::npos) << brief.err;
}

}  // namespace
}  // namespace boxstream::tool_test
