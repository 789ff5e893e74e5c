// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "import/import_file.hpp"
#include "scene/expand.hpp"
#include "scene/scene.hpp"
#include "scene/scene_error.hpp"
#include "simulation/simulation.hpp"
#include "solids.hpp"
#include "tool/scratch_directory.hpp"

namespace boxstream::import_test {
namespace {

using imports::ImportOptions;
using nlohmann::json;
using tool_test::ScratchDirectory;

/// A post, and on it a bar that turns about y, 2 m up. z is up.
const char* const post_and_bar = R"(<robot name="r">
  <link name="post">
    <inertial><origin xyz="0 0 1"/><mass value="10"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><origin xyz="0 0 1"/><geometry><box size="0.2 0.2 2"/></geometry></collision>
  </link>
  <joint name="hinge" type="revolute">
    <parent link="post"/><child link="bar"/><origin xyz="0 0 2.1"/><axis xyz="0 1 0"/>
    <limit lower="-0.5" upper="1" effort="30" velocity="0"/>
  </joint>
  <link name="bar">
    <inertial><origin xyz="0.5 0 0"/><mass value="2"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><origin xyz="0.5 0 0"/><geometry><box size="1 0.1 0.1"/></geometry></collision>
  </link>
</robot>)";

std::string without(std::string text, const std::string& part, const std::string& instead = "") {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos ? text : text.replace(at, part.size(), instead);
}

json import(const std::string& text, const ImportOptions& options = {}) {
  const ScratchDirectory scratch;
  return json::parse(imports::import_file(scratch.write("r.urdf", text), options));
}

std::string complaint(const std::string& text, const ImportOptions& options = {}) {
  const ScratchDirectory scratch;
  const std::string path = scratch.write("r.urdf", text);
  try {
    imports::import_file(path, options);
  } catch (const scenes::SceneError& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.substr(0, path.size() + 2), path + ": ");
    EXPECT_EQ(line.find('\n'), std::string::npos);
    return line.substr(path.size() + 2);
  }
  return {};
}

void expect_near(const json& values, const Vec3& expected) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(values[i].get<double>(), expected[i], 1e-12) << values;
}

TEST(Urdf, LinksAreBodiesAroundTheirCentresOfMass) {
  ImportOptions options;
  options.z_up = false;
  options.position = {5, 0, 0};
  const json all = import(post_and_bar, options);
  ASSERT_EQ(all["bodies"].size(), 2u);
  EXPECT_EQ(all["bodies"][0]["name"], "post");
  EXPECT_EQ(all["bodies"][0]["mass"], 10);
  expect_near(all["bodies"][0]["position"], {5, 0, 1});
  EXPECT_EQ(all["bodies"][1]["mass"], 2);
  expect_near(all["bodies"][1]["position"], {5.5, 0, 2.1});
  ASSERT_EQ(all["shapes"].size(), 2u);
  EXPECT_EQ(all["shapes"][0]["type"], "box");
  expect_near(all["shapes"][0]["half_extents"], {0.1, 0.1, 1});
  ASSERT_EQ(all["joints"].size(), 1u);
  const json& joint = all["joints"][0];
  EXPECT_EQ(joint["type"], "hinge");
  EXPECT_EQ(joint["a"], "bar");
  EXPECT_EQ(joint["b"], "post");
  expect_near(joint["pivot"], {5, 0, 2.1});
  expect_near(joint["axis"], {0, 1, 0});
  EXPECT_NEAR(joint["limits"][0].get<double>(), -0.5 * 180 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(joint["limits"][1].get<double>(), 180 / std::numbers::pi, 1e-12);
  EXPECT_FALSE(joint.contains("motor"));
  EXPECT_TRUE(all["apart"].empty());
}

TEST(Urdf, ItsZIsUpInTheScene) {
  const json all = import(post_and_bar);
  expect_near(all["bodies"][1]["position"], {0.5, 2.1, 0});
  expect_near(all["joints"][0]["axis"], {0, 0, -1});
  EXPECT_NEAR(std::abs(all["bodies"][0]["rotation"]["degrees"].get<double>()), 90, 1e-9);
}

TEST(Urdf, AFixedBaseIsStaticAndApartFromItsNeighbours) {
  ImportOptions options;
  options.fixed_base = true;
  const json all = import(post_and_bar, options);
  EXPECT_EQ(all["bodies"][0]["type"], "static");
  EXPECT_FALSE(all["bodies"][0].contains("mass"));
  EXPECT_FALSE(all["joints"][0].contains("b"));
  EXPECT_EQ(all["apart"], json::parse(R"([["post", "bar"]])"));
}

TEST(Urdf, MotorsHoldOrDrive) {
  ImportOptions options;
  options.hold = true;
  EXPECT_EQ(import(post_and_bar, options)["joints"][0]["motor"], json::parse(R"({"speed": 0, "max_force": 30.0})"));
  options.motors["hinge"] = {1.5, 7};
  EXPECT_EQ(import(post_and_bar, options)["joints"][0]["motor"], json::parse(R"({"speed": 1.5, "max_force": 7.0})"));
  EXPECT_EQ(import(post_and_bar, options)["bodies"][1]["sleep"], false);
  options.motors["knee"] = {1, 1};
  EXPECT_EQ(complaint(post_and_bar, options), "no joint called \"knee\" for a motor");
}

TEST(Urdf, JointsOfEveryKind) {
  const auto kind = [](const std::string& type) {
    return import(without(post_and_bar, "\"revolute\"", '"' + type + '"'))["joints"][0];
  };
  const json slider = kind("prismatic");
  EXPECT_EQ(slider["type"], "slider");
  EXPECT_EQ(slider["limits"], json::parse("[-0.5, 1.0]"));  // metres
  EXPECT_FALSE(kind("continuous").contains("limits"));
  EXPECT_EQ(kind("fixed")["type"], "fixed");
  EXPECT_FALSE(kind("fixed").contains("axis"));
  EXPECT_EQ(complaint(without(post_and_bar, "\"revolute\"", "\"floating\"")),
            "joint \"hinge\": floating joints are not supported");
  EXPECT_EQ(complaint(without(post_and_bar, "\"revolute\"", "\"planar\"")),
            "joint \"hinge\": planar joints are not supported");
}

TEST(Urdf, AMassThatIsMissingComesFromADensityOrIsAnError) {
  const std::string text = without(post_and_bar, R"(<inertial><origin xyz="0.5 0 0"/><mass value="2"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>)");
  EXPECT_EQ(complaint(text), "link \"bar\": no mass, and no density is given");
  ImportOptions options;
  options.density = 500;
  const json all = import(text, options);
  EXPECT_NEAR(all["bodies"][1]["mass"].get<double>(), 500 * 1 * 0.1 * 0.1, 1e-9);
  expect_near(all["bodies"][1]["position"], {0.5, 2.1, 0});
}

TEST(Urdf, MeshesBecomeHullsOrPartsAroundTheCentreOfMass) {
  const ScratchDirectory scratch;
  scratch.write("ell.obj", as_obj(ell()));
  const std::string text =
      without(post_and_bar, R"(<box size="1 0.1 0.1"/>)", R"(<mesh filename="ell.obj" scale="1 1 2"/>)");
  const std::string path = scratch.write("r.urdf", text);
  ImportOptions options;
  options.z_up = false;
  const json hull = json::parse(imports::import_file(path, options));
  ASSERT_EQ(hull["shapes"].size(), 3u);
  EXPECT_EQ(hull["shapes"][1]["type"], "hull");
  EXPECT_EQ(hull["shapes"][1]["points"].size(), 10u);
  // The mesh is at (0.5, 0, 0) in the link's frame, where the centre of mass is too.
  const json& child = hull["shapes"][2]["children"][0];
  double low = 10, high = -10;
  for (const json& p : hull["shapes"][1]["points"]) {
    low = std::min(low, p[0].get<double>() + child["position"][0].get<double>());
    high = std::max(high, p[2].get<double>());
  }
  EXPECT_NEAR(low, 0, 1e-9);
  EXPECT_NEAR(high, 2, 1e-9);
  options.parts.emplace();
  const json parts = json::parse(imports::import_file(path, options));
  ASSERT_EQ(parts["shapes"].size(), 4u);
  EXPECT_EQ(parts["shapes"][3]["type"], "compound");
  EXPECT_EQ(parts["shapes"][3]["children"].size(), 2u);
}

TEST(Urdf, PackagesAreDirectoriesAbove) {
  const ScratchDirectory scratch;
  std::filesystem::create_directories(scratch.file("pkg/urdf"));
  std::filesystem::create_directories(scratch.file("pkg/meshes"));
  scratch.write("pkg/meshes/t.obj", as_obj(tetrahedron()));
  const std::string text =
      without(post_and_bar, R"(<box size="1 0.1 0.1"/>)", R"(<mesh filename="package://pkg/meshes/t.obj"/>)");
  EXPECT_EQ(json::parse(imports::import_file(scratch.write("pkg/urdf/r.urdf", text), {}))["bodies"].size(), 2u);
}

TEST(Urdf, WhatScenesHaveNoWordForIsNamed) {
  const json all = import(without(post_and_bar, "effort=\"30\" velocity=\"0\"/>",
                                  "effort=\"30\" velocity=\"3\"/><dynamics damping=\"0.2\"/>"));
  EXPECT_EQ(all["notes"], json::parse(R"(["damping of joint \"hinge\": left out",
      "limit of speed of joint \"hinge\": left out",
      "inertia tensors: left out, bodies have those of their shapes"])"));
}

TEST(BrokenUrdf, IsRefusedWithOneLine) {
  EXPECT_EQ(complaint("").substr(0, 7), "no URDF");
  EXPECT_EQ(complaint("<robot name=\"r\">").substr(0, 7), "no URDF");
  EXPECT_EQ(complaint("{\"format\": 1}").substr(0, 7), "no URDF");
  EXPECT_EQ(complaint(without(post_and_bar, "link=\"bar\"", "link=\"pub\"")).substr(0, 7), "no URDF");
  EXPECT_NE(complaint(without(post_and_bar, "value=\"2\"", "value=\"two\"")), "");
  EXPECT_NE(complaint(without(post_and_bar, "value=\"2\"", "value=\"nan\"")), "");
  EXPECT_NE(complaint(without(post_and_bar, "value=\"2\"", "value=\"1e999\"")), "");
  EXPECT_EQ(complaint(without(post_and_bar, "value=\"2\"", "value=\"-2\"")),
            "link \"bar\": a size that is not greater than 0");
  EXPECT_EQ(complaint(without(post_and_bar, "1 0.1 0.1", "1 0 0.1")),
            "link \"bar\": a size that is not greater than 0");
  EXPECT_EQ(complaint(without(post_and_bar, "lower=\"-0.5\"", "lower=\"2\"")),
            "joint \"hinge\": limits are not in ascending order");
}

TEST(BrokenUrdf, ALinkOfTwoJointsIsRefused) {
  for (const char* const parent : {"post", "bar"})
    EXPECT_EQ(complaint(without(post_and_bar, "</robot>",
                                "<joint name=\"second\" type=\"fixed\"><parent link=\"" + std::string(parent) +
                                    "\"/><child link=\"bar\"/></joint></robot>")),
              "link \"bar\" hangs on two joints, \"hinge\" and \"second\"");
}

TEST(BrokenUrdf, NestedWithoutEndIsRefused) {
  std::string deep = "<robot name=\"r\">";
  for (int i = 0; i < 5'000; ++i) deep += "<a>";
  EXPECT_NE(complaint(deep), "");
}

TEST(BrokenUrdf, NeverBringsTheProgramDown) {
  const std::string good = post_and_bar;
  std::uint64_t state = 7;
  const auto random = [&](std::size_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::size_t>((state >> 33) % below);
  };
  for (int round = 0; round < 40; ++round) {
    std::string bad = good;
    for (int i = 0; i < 3; ++i) bad[random(bad.size())] = static_cast<char>(random(256));
    if (round % 4 == 0) bad.resize(random(bad.size()));
    complaint(bad);  // one line, or none
  }
}

/// The post and the bar as somebody would write them down in a scene.
const char* const by_hand = R"({"format": 1, "meta": {"name": "hand", "about": "by hand"}, "time": {"dt": 0.01},
  "world": {"bounds": {"min": [-5, -5, -5], "max": [5, 5, 5]}},
  "shapes": [{"name": "post", "type": "box", "half_extents": [0.1, 0.1, 1]},
             {"name": "bar", "type": "box", "half_extents": [0.5, 0.05, 0.05]}],
  "bodies": [{"name": "post", "shape": "post", "type": "static", "position": [0, 1, 0],
              "rotation": {"axis": [-1, 0, 0], "degrees": 90}},
             {"name": "bar", "shape": "bar", "mass": 2, "position": [0.5, 2.1, 0],
              "rotation": {"axis": [-1, 0, 0], "degrees": 90}}],
  "joints": [{"type": "hinge", "a": "bar", "pivot": [0, 2.1, 0], "axis": [0, 0, -1],
              "limits": [-28.64788975654116, 57.29577951308232]}],
  "apart": [["post", "bar"]]})";

TEST(Urdf, MovesLikeTheSameSceneByHand) {
  const ScratchDirectory scratch;
  scratch.write("r.urdf", post_and_bar);
  const scenes::Scene imported = scenes::parse_scene(
      R"({"format": 1, "meta": {"name": "urdf", "about": "imported"}, "time": {"dt": 0.01},
  "world": {"bounds": {"min": [-5, -5, -5], "max": [5, 5, 5]}},
  "generators": [{"type": "import", "file": "r.urdf", "fixed_base": true}]})",
      scratch.file("scene.json"));
  scenes::Simulation a(imported, "boxstream"), b(scenes::parse_scene(by_hand, "hand.json"), "boxstream");
  ASSERT_EQ(a.objects().size(), b.objects().size());
  double lowest = 10;
  for (int step = 0; step < 150; ++step) {
    a.step();
    b.step();
    for (std::size_t i = 0; i < 2; ++i) {
      const btVector3 p = a.objects()[i]->getWorldTransform().getOrigin();
      const btVector3 q = b.objects()[i]->getWorldTransform().getOrigin();
      ASSERT_LT(p.distance(q), 1e-4f) << "body " << i << " in step " << step;
    }
    lowest = std::min(lowest, double{a.objects()[1]->getWorldTransform().getOrigin().y()});
  }
  // It swings down by 1 rad, where the limit stops it: positive turns about URDF's y take x down.
  EXPECT_NEAR(lowest, 2.1 - 0.5 * std::sin(1.0), 0.03);
}

TEST(Urdf, OfTheDemoHasFourJoints) {
  const json all = json::parse(imports::import_file(BOXSTREAM_TEST_ROBOTS "/arm.urdf", {}));
  EXPECT_EQ(all["bodies"].size(), 5u);
  EXPECT_EQ(all["joints"].size(), 4u);
  EXPECT_EQ(all["joints"][3]["type"], "slider");
}

}  // namespace
}  // namespace boxstream::import_test
