// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "formats/scene_json/load_scene.hpp"
#include "process.hpp"
#include "scratch_directory.hpp"

namespace boxstream::import_test {
namespace {

using tool_test::Outcome;
using tool_test::run_tool;
using tool_test::ScratchDirectory;

const std::string arm = scenes::shipped("robots/arm.urdf");

TEST(ImportCommand, WritesASceneThatRuns) {
  const ScratchDirectory scratch;
  const std::string scene = scratch.file("arm.json");
  const Outcome made = run_tool({"import", arm, "-o", scene, "--fixed-base", "--hold", "--floor", "0"});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.out, "");
  EXPECT_NE(made.err.find("boxstream: note: limit of speed of joint \"turn\", \"shoulder\", \"elbow\""),
            std::string::npos)
      << made.err;
  const scenes::Scene read = scenes::load_scene(scene);
  EXPECT_EQ(read.meta.name, "arm");
  EXPECT_EQ(read.bodies.size(), 6u);  // five links and the floor
  EXPECT_EQ(read.joints.size(), 4u);
  EXPECT_EQ(read.exclusions.size(), 1u);
  const Outcome run = run_tool({"simulate", scene, "--steps", "20", "--compare", "dbvt"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("pairs equal         yes"), std::string::npos) << run.out;
}

TEST(ImportCommand, WritesToStandardOutput) {
  const Outcome made = run_tool({"import", scenes::shipped("meshes/ring.obj"), "-o", "-", "--hulls", "4"});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  const auto scene = nlohmann::json::parse(made.out);
  EXPECT_EQ(scene["shapes"].size(), 5u);  // four parts and their compound
  EXPECT_EQ(scenes::parse_scene(made.out, "out").bodies.size(), 1u);
}

TEST(ImportCommand, RefusesWhatItCannotRead) {
  const ScratchDirectory scratch;
  const std::string scene = scratch.file("out.json");
  const auto refuse = [&](const std::string& name, const std::string& text, const std::string& line) {
    const std::string file = scratch.write(name, text);
    const Outcome outcome = run_tool({"import", file, "-o", scene});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "boxstream: " + file + ": " + line + "\n");
    EXPECT_FALSE(std::filesystem::exists(scene));
  };
  refuse(
      "a.urdf",
      "<robot name=\"r\"><link name=\"world\"/><link name=\"a\"><collision><geometry><sphere radius=\"1\"/></geometry>"
      "</collision></link><joint name=\"j\" type=\"continuous\"><parent link=\"world\"/><child link=\"a\"/></joint>"
      "</robot>",
      "link \"a\": no mass, and no density is given");
  refuse("a.bullet", "BULLETf-v324", "cut off after its header");
  refuse("a.txt", "",
         "not a kind of file that is imported (.urdf, .bullet, .obj, .stl, .ply, .off, .dae, .gltf, .glb)");
  refuse("heavy.urdf",
         "<robot name=\"r\"><link name=\"a\"><inertial><mass value=\"1e12\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" "
         "iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial><collision><geometry><sphere radius=\"1\"/></geometry></collision>"
         "</link></robot>",
         "/bodies/0/mass: must be at most 1000000000, got 1000000000000 (body \"a\")");
}

}  // namespace
}  // namespace boxstream::import_test
