// SPDX-License-Identifier: MIT
// What a foreign scene, a typing error or a signal could destroy.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "process.hpp"
#include "refusal.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json small_scene(int steps = 3) {
  return {{"format", 1},
          {"meta", {{"name", "ball"}, {"about", "A ball falls."}}},
          {"time", {{"dt", 0.01}, {"steps", steps}}},
          {"world", {{"bounds", {{"min", {-9, -9, -9}}, {"max", {9, 9, 9}}}}}},
          {"shapes", {{{"name", "ball"}, {"type", "sphere"}, {"radius", 0.5}}}},
          {"bodies", {{{"shape", "ball"}, {"mass", 2}, {"position", {0, 4, 0}}}}}};
}

RunOptions in(const std::string& directory) {
  RunOptions options;
  options.directory = directory;
  return options;
}

TEST(Harm, ASceneNamesOutputsBelowTheCurrentFolderOnly) {
  const ScratchDirectory here, elsewhere;
  fs::create_directory(here.file("sub"));
  fs::create_directory_symlink(elsewhere.file("."), here.file("link"));
  elsewhere.write("a.csv", "precious");
  json scene = small_scene();
  for (const std::string& name :
       {elsewhere.file("a.csv"), std::string("../a.csv"), std::string("sub/../../a.csv"), std::string("link/a.csv")}) {
    scene["outputs"] = {{"csv", name}};
    expect_refusal(run_tool({"simulate", here.write("s.json", scene.dump())}, in(here.file("."))),
                   {"s.json: /outputs: " + name, "current folder", "--outputs-anywhere"});
  }
  EXPECT_EQ(elsewhere.read("a.csv"), "precious");
  EXPECT_EQ(here.count(), 3U);

  for (const char* const block : {"view", "trace"}) {
    scene["outputs"] = {{block, std::string("/tmp/../a.") + (std::string(block) == "view" ? "html" : "json")}};
    expect_refusal(run_tool({"simulate", here.write("s.json", scene.dump())}, in(here.file("."))), {"current folder"});
  }
  for (const char* const ending : {"bsrec", "aabbs", "glb"}) {
    scene["outputs"] = {{"record", {elsewhere.file("a.") + ending}}};
    expect_refusal(run_tool({"simulate", here.write("s.json", scene.dump())}, in(here.file("."))), {"current folder"});
  }

  scene["outputs"] = {{"csv", "sub/a.csv"}};
  const Outcome below = run_tool({"simulate", here.write("s.json", scene.dump())}, in(here.file(".")));
  EXPECT_EQ(below.exit_code, 0) << below.err;
  EXPECT_TRUE(here.read("sub/a.csv").starts_with("step,"));
  scene["outputs"] = {{"csv", elsewhere.file("a.csv")}};
  const std::string outside = here.write("s.json", scene.dump());
  EXPECT_EQ(run_tool({"simulate", outside, "--csv", "b.csv"}, in(here.file("."))).exit_code, 0);
  EXPECT_EQ(elsewhere.read("a.csv"), "precious");
  EXPECT_EQ(run_tool({"simulate", outside, "--outputs-anywhere"}, in(here.file("."))).exit_code, 0);
  EXPECT_TRUE(elsewhere.read("a.csv").starts_with("step,"));
}

TEST(Harm, NoOutputIsAnInput) {
  const ScratchDirectory here;
  const std::string scene = here.write("s.json", small_scene().dump());
  fs::create_hard_link(scene, here.file("hard.json"));
  fs::create_symlink("s.json", here.file("soft.json"));
  for (const char* const name : {"s.json", "./s.json", "hard.json", "soft.json"}) {
    for (const char* const option : {"--json", "--csv", "--trace", "--log"}) {
      if (std::string(option) == "--trace" && !std::string(name).ends_with(".json")) continue;
      expect_refusal(run_tool({"simulate", "s.json", option, name}, in(here.file("."))), {name, "input"});
    }
    expect_refusal(run_tool({"explain", "s.json", "--json", name}, in(here.file("."))), {name, "input"});
    expect_refusal(run_tool({"accuracy", "s.json", "--knob", "substeps=1", "--csv", name}, in(here.file("."))),
                   {"input"});
  }
  EXPECT_EQ(here.read("s.json"), small_scene().dump());

  ASSERT_EQ(run_tool({"simulate", "s.json", "--log", "a.bsrec", "--record", "a.aabbs"}, in(here.file("."))).exit_code,
            0);
  const std::string log = here.read("a.bsrec"), boxes = here.read("a.aabbs");
  expect_refusal(run_tool({"replay", "a.bsrec", "--json", "a.bsrec"}, in(here.file("."))), {"a.bsrec", "input"});
  expect_refusal(run_tool({"aabbs", "a.aabbs", "--json", "a.aabbs"}, in(here.file("."))), {"a.aabbs", "input"});
  EXPECT_EQ(here.read("a.bsrec"), log);
  EXPECT_EQ(here.read("a.aabbs"), boxes);

  here.write("points", "0 0 0\n1 0 0\n");
  for (const char* const option : {"--csv", "--json", "--save"})
    expect_refusal(run_tool({"near", "points", "--radius", "2", option, "points"}, in(here.file("."))), {"input"});
  EXPECT_EQ(here.read("points"), "0 0 0\n1 0 0\n");
  EXPECT_EQ(here.count(), 6U);
}

const char* const triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// What a scene reads beside itself is an input too, even if a child process of the reader has read it.
TEST(Harm, NoOutputIsAFileThatTheSceneIncludes) {
  const ScratchDirectory here;
  here.write("part.obj", triangle);
  fs::create_hard_link(here.file("part.obj"), here.file("part.csv"));
  here.write("robot.urdf",
             R"(<robot name="r"><link name="a"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" )"
             R"(ixz="0" iyz="0"/></inertial><collision><geometry><mesh filename="part.obj"/></geometry></collision>)"
             R"(</link></robot>)");
  json shapes = small_scene();
  shapes["shapes"].push_back({{"name", "part"}, {"type", "hull"}, {"file", "part.obj"}});
  json robot = small_scene();
  robot["generators"] = {{{"type", "import"}, {"file", "robot.urdf"}}};
  for (const json& scene : {shapes, robot}) {
    here.write("s.json", scene.dump());
    ASSERT_EQ(run_tool({"simulate", "s.json"}, in(here.file("."))).exit_code, 0);
    for (const char* const name : {"part.obj", "part.csv"})
      expect_refusal(run_tool({"simulate", "s.json", "--csv", name}, in(here.file("."))), {name, "input"});
  }
  expect_refusal(run_tool({"simulate", "s.json", "--csv", "robot.urdf"}, in(here.file("."))), {"robot.urdf", "input"});
  for (const char* const name : {"robot.urdf", "part.obj"})
    expect_refusal(run_tool({"import", "robot.urdf", "-o", name}, in(here.file("."))), {name, "input"});
  fs::create_symlink("part.obj", here.file("part.ply"));
  expect_refusal(run_tool({"mesh", "check", "part.obj", "--picture", "part.ply"}, in(here.file("."))), {"input"});
  EXPECT_EQ(here.read("part.obj"), triangle);
  EXPECT_EQ(here.count(), 5U);
}

TEST(Harm, ModesOfFilesThatAreReplacedStay) {
  const ScratchDirectory here;
  here.write("s.json", small_scene().dump());
  chmod(here.write("a.csv", "").c_str(), 0600);
  ASSERT_EQ(run_tool({"simulate", "s.json", "--csv", "a.csv"}, in(here.file("."))).exit_code, 0);
  EXPECT_EQ(fs::status(here.file("a.csv")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(Harm, PicturesLeaveDevicesWhereTheyAre) {
  const ScratchDirectory here;
  here.write("s.json", small_scene().dump());
  // By names with an ending that pictures have: what is removed is what is named.
  fs::create_symlink("/dev/full", here.file("full.png"));
  fs::create_symlink("/dev/null", here.file("null.svg"));
  const Outcome full = run_tool({"simulate", "s.json", "--picture", "full.png"}, in(here.file(".")));
  EXPECT_EQ(full.exit_code, 1) << full.err;
  EXPECT_NE(full.err.find("No space left on device"), std::string::npos) << full.err;
  EXPECT_EQ(run_tool({"simulate", "s.json", "--picture", "null.svg"}, in(here.file("."))).exit_code, 0);
  EXPECT_TRUE(fs::is_character_file(here.file("full.png")));
  EXPECT_TRUE(fs::is_character_file(here.file("null.svg")));
  expect_refusal(run_tool({"simulate", "s.json", "--picture", "/dev/null"}, in(here.file("."))), {".png", ".svg"});
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const Outcome result = run_tool({"simulate", "s.json", "--json", "/dev/full"}, in(here.file(".")));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("/dev/full: cannot be written: No space left on device"), std::string::npos) << result.err;
}

TEST(Harm, SignalsLeaveNothingHalfWritten) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const ScratchDirectory here;
    here.write("s.json", small_scene(10'000'000).dump());
    here.write("b.json", "earlier");
    RunOptions options = in(here.file("."));
    bool seen = false;
    options.meanwhile = [&](int process) {
      for (int i = 0; i < 1000 && !seen; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        seen = here.count() == 4;
      }
      kill(process, signal);
    };
    const Outcome run = run_tool({"simulate", "s.json", "--log", "a.bsrec", "--json", "b.json"}, options);
    EXPECT_TRUE(seen) << "nothing was begun";
    EXPECT_EQ(run.exit_code, 128 + signal);
    EXPECT_EQ(here.count(), 2U) << "a part is left";
    EXPECT_EQ(here.read("b.json"), "earlier");
  }
}

}  // namespace
}  // namespace boxstream::tool_test
