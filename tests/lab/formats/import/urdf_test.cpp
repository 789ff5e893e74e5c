// SPDX-License-Identifier: MIT
// What becomes of a robot's links, joints, masses and meshes.
#include <array>
#include <cmath>
#include <numbers>

#include "formats/import/geometry.hpp"
#include "formats/import/mesh.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/expand.hpp"
#include "solids.hpp"
#include "urdf_robot.hpp"

namespace boxstream::import_test {
namespace {

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
  EXPECT_TRUE(all["exclusions"].empty());
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
  EXPECT_EQ(all["exclusions"], json::parse(R"([["post", "bar"]])"));
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
  options.motors.erase("knee");
  for (const std::string type : {"fixed", "floating"})
    EXPECT_EQ(complaint(without(post_and_bar, "revolute", type), options),
              "joint \"hinge\" is " + type + ": no motor moves it");
}

TEST(Urdf, JointsOfEveryKind) {
  const auto kind = [](const std::string& type) {
    return import(without(post_and_bar, "\"revolute\"", '"' + type + '"'))["joints"][0];
  };
  const json slider = kind("prismatic");
  EXPECT_EQ(slider["type"], "slider");
  EXPECT_EQ(slider["limits"], json::parse("[-0.5, 1.0]"));  // metres
  EXPECT_FALSE(kind("continuous").contains("limits"));
  const json floating = import(without(post_and_bar, "\"revolute\"", "\"floating\""));
  EXPECT_EQ(floating["bodies"].size(), 2u);
  EXPECT_TRUE(floating["joints"].empty());
  EXPECT_EQ(complaint(without(post_and_bar, "\"revolute\"", "\"planar\"")),
            "joint \"hinge\": planar joints are not supported");
}

/// As generators of robots write them for "unlimited".
TEST(Urdf, NumbersWithoutMeaningAreNoLimits) {
  const auto slider = [](const std::string& limits) {
    return without(without(post_and_bar, "\"revolute\"", "\"prismatic\""), R"(lower="-0.5" upper="1" effort="30")",
                   limits);
  };
  const json endless = import(slider(R"(lower="-1e7" upper="1e7" effort="30")"));
  EXPECT_FALSE(endless["joints"][0].contains("limits"));
  EXPECT_EQ(endless["notes"], json::parse(R"(["limits beyond 100 km of joint \"hinge\": left out"])"));
  // An end that is near stops the joint all the same.
  const std::pair<const char*, const char*> cases[] = {{R"(lower="-1e5" upper="1e5" effort="30")", "[-1e5, 1e5]"},
                                                       {R"(lower="-0.375" upper="1e16" effort="30")", "[-0.375, 1e5]"},
                                                       {R"(lower="-3e9" upper="0.75" effort="30")", "[-1e5, 0.75]"}};
  for (const auto& [limits, expected] : cases)
    EXPECT_EQ(import(slider(limits))["joints"][0]["limits"], json::parse(expected)) << limits;
  ImportOptions options;
  options.hold = true;
  EXPECT_EQ(import(slider(R"(lower="0" upper="2" effort="4e12")"), options)["joints"][0]["motor"]["max_force"], 1e9);
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

/// A ball of 0.3 m at (0, 0, 0.5) that is fixed to the bar.
TEST(Urdf, ADensityWeighsLinksThatAreFixedToOnesWithAMass) {
  const std::string text = without(post_and_bar, "</robot>", R"(<link name="knob"><collision><geometry>
      <sphere radius="0.3"/></geometry></collision></link><joint name="weld" type="fixed"><parent link="bar"/>
      <child link="knob"/><origin xyz="0 0 0.5"/></joint></robot>)");
  ImportOptions options;
  options.z_up = false;
  EXPECT_EQ(import(text, options)["bodies"][1]["mass"], 2);
  options.density = 25;
  const double ball = 25 * 4 * std::numbers::pi / 3 * 0.3 * 0.3 * 0.3, mass = 2 + ball;
  const json bar = import(text, options)["bodies"][1];
  EXPECT_NEAR(bar["mass"].get<double>(), mass, 1e-12);
  // Of 2 kg at (0.5, 0, 2.1) and the ball at (0, 0, 2.6).
  expect_near(bar["position"], {2 * 0.5 / mass, 0, (2 * 2.1 + ball * 2.6) / mass});
  // Trace of the tensors of both, and of two masses 0.5 sqrt(2) apart.
  const auto moments = bar["inertia"].get<Vec3>();
  EXPECT_NEAR(moments[0] + moments[1] + moments[2], 3 + 3 * 0.4 * ball * 0.09 + 2 * (2 * ball / mass) * 0.5, 1e-9);
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

/// Robots drawn in micrometres have scales that are equal to six decimals.
TEST(Urdf, AMeshOfTwoScalesIsTwoMeshes) {
  const ScratchDirectory scratch;
  scratch.write("corner.obj", "v 0 0 0\nv 1e6 0 0\nv 0 1e6 0\nv 0 0 1e6\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto mesh = [](const std::string& scale) {
    return "<mesh filename=\"corner.obj\" scale=\"" + scale + " " + scale + " " + scale + "\"/>";
  };
  const std::string text = without(post_and_bar, R"(<box size="1 0.1 0.1"/>)",
                                   mesh("3e-7") + "</geometry></collision><collision><geometry>" + mesh("4e-7"));
  const json shapes = json::parse(imports::import_file(scratch.write("r.urdf", text), {}))["shapes"];
  for (const auto& [shape, side] : {std::pair(1u, 0.3), std::pair(2u, 0.4)}) {
    ASSERT_EQ(shapes[shape]["points"].size(), 4u);
    double low = 10, high = -10;
    for (const json& p : shapes[shape]["points"]) {
      low = std::min(low, p[0].get<double>());
      high = std::max(high, p[0].get<double>());
    }
    EXPECT_NEAR(high - low, side, 1e-9);
  }
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
      "limit of speed of joint \"hinge\": left out"])"));
}

TEST(Urdf, ElementsOfOtherProgramsAreNamed) {
  const json all =
      import(without(post_and_bar, "</robot>", R"(<gazebo reference="bar"><mu1>0.7</mu1></gazebo></robot>)"));
  EXPECT_EQ(all["notes"], json::parse(R"(["elements <gazebo>: left out"])"));
  const json contact = import(without(post_and_bar, "<link name=\"bar\">",
                                      R"(<link name="bar"><contact><lateral_friction value="0.2"/></contact>)"));
  EXPECT_EQ(contact["notes"], json::parse(R"(["elements <contact>: left out"])"));
  for (const char* const none : {R"(<contact_coefficients mu="0.3"/>)", R"(<!-- <gazebo/> --><!-- <contact>
      </contact> -->)"})
    EXPECT_TRUE(import(without(post_and_bar, "</robot>", none + std::string("</robot>")))["notes"].empty()) << none;
  const json both = import(without(post_and_bar, "</robot>", "<!-- one --><gazebo\n/><!-- two --><contact/></robot>"));
  EXPECT_EQ(both["notes"], json::parse(R"(["elements <contact>: left out", "elements <gazebo>: left out"])"));
}

/// The tensor that a body of the scene has, about its centre and along the axes of the file.
std::array<Vec3, 3> tensor_of(const json& body) {
  const auto moments = body["inertia"].get<Vec3>();
  imports::Quat turn{0, 0, 0, 1};
  if (body.contains("rotation")) {
    const auto axis = body["rotation"]["axis"].get<Vec3>();
    const double half = body["rotation"]["degrees"].get<double>() * std::numbers::pi / 360;
    turn = {axis[0] * std::sin(half), axis[1] * std::sin(half), axis[2] * std::sin(half), std::cos(half)};
  }
  std::array<Vec3, 3> tensor{};
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3 unit{};
    unit[k] = 1;
    const Vec3 along = imports::turned(turn, unit);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) tensor[i][j] += moments[k] * along[i] * along[j];
  }
  return tensor;
}

void expect_tensor(const json& body, const std::array<Vec3, 3>& expected) {
  const auto tensor = tensor_of(body);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(tensor[i][j], expected[i][j], 1e-9) << i << j;
}

TEST(Urdf, InertiaComesAlongWhateverItsAxes) {
  ImportOptions options;
  options.z_up = false;
  const std::string was = R"(<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><origin xyz="0.5 0 0"/>)";
  const std::string text =
      without(post_and_bar, was, R"(<inertia ixx="0.5" ixy="0.1" ixz="-0.05" iyy="0.6" iyz="0.2" izz="0.9"/></inertial>
    <collision><origin xyz="0.5 0 0"/>)");
  const json all = import(text, options);
  const json& bar = all["bodies"][1];
  expect_near(bar["position"], {0.5, 0, 2.1});
  expect_tensor(bar, {{{0.5, 0.1, -0.05}, {0.1, 0.6, 0.2}, {-0.05, 0.2, 0.9}}});
  // The shape stays where it was: half a metre to both sides of the centre along the file's x.
  const json& child = all["shapes"].back()["children"][0];
  const double body_angle = bar["rotation"]["degrees"].get<double>(),
               shape_angle = child["rotation"]["degrees"].get<double>();
  EXPECT_NEAR(std::abs(body_angle), std::abs(shape_angle), 1e-9);
  // Turned with its frame.
  const json turned = import(without(text, R"(<origin xyz="0.5 0 0"/><mass value="2"/>)",
                                     R"(<origin xyz="0.5 0 0" rpy="0 0 1.5707963267948966"/><mass value="2"/>)"),
                             options);
  expect_tensor(turned["bodies"][1], {{{0.6, -0.1, -0.2}, {-0.1, 0.5, -0.05}, {-0.2, -0.05, 0.9}}});
}

TEST(Urdf, InertiaThatNoBodyHasIsSaidAndThatOfTheShapeIsTaken) {
  const json all = import(without(post_and_bar, R"(<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><origin xyz="0.5 0 0"/>)",
                                  R"(<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>
    <collision><origin xyz="0.5 0 0"/>)"));
  EXPECT_FALSE(all["bodies"][1].contains("inertia"));
  EXPECT_EQ(all["notes"],
            json::parse(R"(["inertia that no body has, so that it is as its shapes say: link \"bar\""])"));
}

TEST(Urdf, LinksThatAreFixedToEachOtherAreOneBody) {
  ImportOptions options;
  options.z_up = false;
  const json all = import(without(post_and_bar, "\"revolute\"", "\"fixed\""), options);
  ASSERT_EQ(all["bodies"].size(), 1u);
  EXPECT_TRUE(all["joints"].empty());
  const json& body = all["bodies"][0];
  EXPECT_EQ(body["mass"], 12);
  // 10 kg at (0, 0, 1), 2 kg at (0.5, 0, 2.1).
  const Vec3 centre{1.0 / 12, 0, 14.2 / 12};
  expect_near(body["position"], centre);
  std::array<Vec3, 3> expected{{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
  for (const auto& [mass, at] : {std::pair{10.0, Vec3{0, 0, 1}}, std::pair{2.0, Vec3{0.5, 0, 2.1}}}) {
    const Vec3 d = imports::minus(at, centre);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) expected[i][j] += mass * ((i == j ? imports::dot(d, d) : 0) - d[i] * d[j]);
  }
  expect_tensor(body, expected);
  EXPECT_EQ(all["shapes"].back()["children"].size(), 2u);
}

TEST(Urdf, CapsulesAreCapsules) {
  const json all =
      import(without(post_and_bar, R"(<box size="1 0.1 0.1"/>)", R"(<capsule length="0.8" radius="0.1"/>)"));
  const json& capsule = all["shapes"][1];
  EXPECT_EQ(capsule["type"], "capsule");
  EXPECT_EQ(capsule["radius"], 0.1);
  EXPECT_EQ(capsule["height"], 0.8);
  EXPECT_EQ(complaint(without(post_and_bar, R"(<box size="1 0.1 0.1"/>)", R"(<capsule radius="0.1"></capsule>)")),
            "link \"bar\": a capsule without radius and length");
}

/// A box of 1 x 2 x 3 in Collada, which says that z is up, in centimetres.
const char* const collada = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
 <library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="pa" count="24">0 0 0 100 0 0 100 200 0 0 200 0 0 0 300 100 0 300 100 200 300 0 200 300</float_array>
   <technique_common><accessor source="#pa" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
    <param name="Z" type="float"/></accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/>
   <p>0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 4 3 4 7</p></triangles>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>)";

TEST(Urdf, MeshesInColladaHaveTheAxesOfTheLink) {
  const ScratchDirectory scratch;
  scratch.write("box.dae", collada);
  const std::string text = without(post_and_bar, R"(<box size="1 0.1 0.1"/>)", R"(<mesh filename="box.dae"/>)");
  const json all = json::parse(imports::import_file(scratch.write("r.urdf", text), {}));
  ASSERT_EQ(all["shapes"][1]["points"].size(), 8u);
  Vec3 low{9, 9, 9}, high{-9, -9, -9};
  for (const json& p : all["shapes"][1]["points"])
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d].get<double>());
      high[d] = std::max(high[d], p[d].get<double>());
    }
  const Vec3 expected[] = {{0.5, 0, 0}, {1.5, 2, 3}};
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(low[d], expected[0][d], 1e-6);
    EXPECT_NEAR(high[d], expected[1][d], 1e-6);
  }
  const auto mesh = imports::read_mesh(scratch.file("box.dae"));  // by itself, as it says: y is up in scenes
  for (const Vec3& v : mesh.vertices) EXPECT_LE(v[1], 3 + 1e-6);
  EXPECT_NEAR(std::max_element(mesh.vertices.begin(), mesh.vertices.end(),
                               [](const Vec3& a, const Vec3& b) { return a[1] < b[1]; })
                  ->at(1),
              3, 1e-6);
}

TEST(Urdf, PackagesAreFoundWhateverTheirFolderIsCalled) {
  const ScratchDirectory scratch;
  for (const char* const folder : {"checkout/urdf", "checkout/meshes", "elsewhere/parts/meshes", "away/things/meshes"})
    std::filesystem::create_directories(scratch.file(folder));
  const auto robot = [&](const std::string& mesh) {
    return scratch.write("checkout/urdf/r.urdf",
                         without(post_and_bar, R"(<box size="1 0.1 0.1"/>)", "<mesh filename=\"" + mesh + "\"/>"));
  };
  scratch.write("checkout/meshes/t.obj", as_obj(tetrahedron()));
  scratch.write("elsewhere/parts/meshes/t.obj", as_obj(ell()));
  scratch.write("away/things/meshes/u.obj", as_obj(tetrahedron()));
  const auto corners = [&](const std::string& mesh, const ImportOptions& options) {
    return json::parse(imports::import_file(robot(mesh), options))["shapes"][1]["points"].size();
  };
  ImportOptions options;
  EXPECT_EQ(corners("package://pkg/meshes/t.obj", options), 4u);  // checkout is pkg
  EXPECT_EQ(corners("package:///pkg/meshes/t.obj", options), 4u);
  options.packages = {scratch.file("elsewhere")};
  EXPECT_EQ(corners("package://parts/meshes/t.obj", options), 10u);  // a folder that holds packages
  options.packages = {scratch.file("away/things")};
  EXPECT_EQ(corners("package://pkg/meshes/u.obj", options), 4u);  // the package itself
  const std::string path = robot("package://pkg/meshes/u.obj");
  try {
    imports::import_file(path, {});
    FAIL();
  } catch (const scenes::SceneError& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find("package://pkg/meshes/u.obj: no such file; searched "), std::string::npos) << line;
    EXPECT_NE(line.find("checkout/urdf and all folders above it; --package-path names others"), std::string::npos)
        << line;
  }
}

TEST(Urdf, ARootWithoutMassStandsStillAndIsNamed) {
  for (const char* const root :
       {"<link name=\"floor\"/>",
        "<link name=\"floor\"><collision><geometry><sphere radius=\"0.01\"/></geometry></collision></link>"}) {
    const json all = import(without(
        post_and_bar, "</robot>",
        std::string(root) + "<joint name=\"stand\" type=\"revolute\"><parent link=\"floor\"/>"
                            "<child link=\"post\"/><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" "
                            "velocity=\"0\"/></joint></robot>"));
    EXPECT_EQ(all["joints"].size(), 2u);
    EXPECT_FALSE(all["joints"][0].contains("b"));
    EXPECT_EQ(all["notes"][0], "root link \"floor\" has no mass: it stands still, as a fixed base does");
  }
}

TEST(Urdf, AJointStartsInTheMiddleOfLimitsThatZeroIsNotWithin) {
  ImportOptions options;
  options.z_up = false;
  options.hold = true;
  const json all = import(without(post_and_bar, "lower=\"-0.5\" upper=\"1\"", "lower=\"0.2\" upper=\"1\""), options);
  // Turned by 0.6 about y, which takes x down.
  expect_near(all["bodies"][1]["position"], {0.5 * std::cos(0.6), 0, 2.1 - 0.5 * std::sin(0.6)});
  EXPECT_NEAR(all["joints"][0]["limits"][0].get<double>(), -0.4 * 180 / std::numbers::pi, 1e-9);
  EXPECT_NEAR(all["joints"][0]["limits"][1].get<double>(), 0.4 * 180 / std::numbers::pi, 1e-9);
  EXPECT_EQ(all["notes"][0], "starts in the middle of its limits, which 0 is not within: joint \"hinge\"");
  const json slider = import(without(without(post_and_bar, "lower=\"-0.5\" upper=\"1\"", "lower=\"0.2\" upper=\"1\""),
                                     "\"revolute\"", "\"prismatic\""),
                             options);
  expect_near(slider["bodies"][1]["position"], {0.5, 0.6, 2.1});
  EXPECT_NEAR(slider["joints"][0]["limits"][1].get<double>(), 0.4, 1e-12);
}

TEST(Urdf, LinksThatTouchAtTheStartPassThroughEachOther) {
  const auto with_tool = [](const std::string& at) {
    return without(
        post_and_bar, "</robot>",
        "<link name=\"tool\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" "
        "iyz=\"0\" izz=\"1\"/></inertial><collision><geometry><sphere radius=\"0.1\"/></geometry></collision></link>"
        "<joint name=\"wrist\" type=\"continuous\"><parent link=\"bar\"/><child link=\"tool\"/><origin xyz=\"" +
            at + "\"/><axis xyz=\"0 0 1\"/></joint></robot>");
  };
  EXPECT_EQ(import(with_tool("0 0 -0.15"))["exclusions"], json::parse(R"([["post", "tool"]])"));
  EXPECT_TRUE(import(with_tool("0.5 0 0"))["exclusions"].empty());
}

TEST(Urdf, OfTheDemoHasFourJoints) {
  const json all = json::parse(imports::import_file(scenes::shipped("robots/arm.urdf"), {}));
  EXPECT_EQ(all["bodies"].size(), 5u);
  EXPECT_EQ(all["joints"].size(), 4u);
  EXPECT_EQ(all["joints"][3]["type"], "slider");
}

}  // namespace
}  // namespace boxstream::import_test
