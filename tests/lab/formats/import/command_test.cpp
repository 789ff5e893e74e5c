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

TEST(ImportCommand, CutsUntilTheVolumeIsNearEnough) {
  const auto made = [](const char* error) {
    return run_tool({"import", scenes::shipped("meshes/ring.obj"), "-o", "-", "--hulls", "4", "--error", error});
  };
  const Outcome rough = made("0.7"), fine = made("0.6");  // the hull of the whole is larger by 0.67
  EXPECT_EQ(nlohmann::json::parse(rough.out)["shapes"].size(), 1u);
  EXPECT_NE(rough.err.find("the volume of its 1 convex parts is "), std::string::npos) << rough.err;
  EXPECT_GT(nlohmann::json::parse(fine.out)["shapes"].size(), 2u);
}

TEST(ImportCommand, KeepsAMeshThatIsStatic) {
  const Outcome made = run_tool({"import", scenes::shipped("meshes/ring.obj"), "-o", "-", "--static"});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  const auto scene = nlohmann::json::parse(made.out);
  ASSERT_EQ(scene["shapes"].size(), 1u);
  EXPECT_EQ(scene["shapes"][0]["type"], "mesh");
  ASSERT_EQ(scene["bodies"].size(), 1u);
  EXPECT_EQ(scene["bodies"][0]["type"], "static");
  EXPECT_FALSE(scene["bodies"][0].contains("mass"));
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
