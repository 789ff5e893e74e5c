// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "formats/import/geometry.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/expand.hpp"
#include "formats/scene_model/scene_error.hpp"
#include "scratch_directory.hpp"
#include "solids.hpp"

namespace boxstream::import_test {
namespace {

using scenes::Scene;
using tool_test::ScratchDirectory;

class ImportingScene : public testing::Test {
 protected:
  ImportingScene() {
    scratch.write("ell.obj", as_obj(ell()));
    scratch.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }

  /// A scene of the blocks, beside the files.
  Scene load(const std::string& blocks) const {
    return scenes::parse_scene(R"({"format": 1, "meta": {"name": "n", "about": "a"}, "time": {"dt": 0.01},
      "world": {"bounds": {"min": [-5, -5, -5], "max": [5, 5, 5]}}, )" +
                                   blocks + "}",
                               scratch.file("scene.json"));
  }
  std::string complaint(const std::string& blocks) const {
    try {
      load(blocks);
    } catch (const scenes::SceneError& error) {
      std::string line = error.what();
      const std::string place = scratch.file("");
      for (std::size_t at; (at = line.find(place)) != std::string::npos;) line.erase(at, place.size());
      return line;
    }
    return {};
  }
  std::string bad_shape(const std::string& shape) const {
    return complaint(R"("shapes": [{"name": "s", )" + shape + "}]");
  }

  ScratchDirectory scratch;
};

#ifdef BOXSTREAM_HAS_ASSIMP

TEST_F(ImportingScene, HasAMeshFromAFile) {
  const Scene scene = load(R"("shapes": [{"name": "s", "type": "mesh", "file": "ell.obj", "scale": [1, 1, 2],
    "internal_edges": true}], "bodies": [{"shape": "s", "type": "static"}])");
  const auto& mesh = std::get<scenes::MeshShape>(scene.shapes[0].value);
  EXPECT_EQ(mesh.vertices.size(), 12u);
  EXPECT_TRUE(mesh.internal_edges);
  EXPECT_NEAR(imports::measure(mesh.vertices, mesh.triangles).volume, 6, 1e-9);
}

TEST_F(ImportingScene, HasAHullFromAFile) {
  const Scene scene = load(R"("shapes": [{"name": "s", "type": "hull", "file": "ell.obj", "scale": 2}],
    "bodies": [{"shape": "s", "mass": 1}])");
  EXPECT_EQ(std::get<scenes::HullShape>(scene.shapes[0].value).points.size(), 10u);  // all but those of the notch
}

TEST_F(ImportingScene, HasACompoundOfPartsFromAFile) {
  const Scene scene = load(R"("shapes": [{"name": "s", "type": "compound", "file": "ell.obj"},
    {"name": "t", "type": "sphere", "radius": 1}], "bodies": [{"shape": "s", "mass": 1}, {"shape": "t", "mass": 1}])");
  ASSERT_EQ(scene.shapes.size(), 4u);
  const scenes::Shape& shape = scene.shapes[scene.bodies[0].traits.shape];
  EXPECT_EQ(shape.name, "s");
  const auto& compound = std::get<scenes::CompoundShape>(shape.value);
  ASSERT_EQ(compound.children.size(), 2u);
  for (const auto& child : compound.children)
    EXPECT_EQ(std::get<scenes::HullShape>(scene.shapes[child.shape].value).points.size(), 8u);
  EXPECT_EQ(scene.shapes[scene.bodies[1].traits.shape].name, "t");
  const Scene one = load(R"("shapes": [{"name": "s", "type": "compound", "file": "ell.obj",
    "decompose": {"max_hulls": 1}}])");
  EXPECT_EQ(one.shapes.size(), 2u);
}

TEST_F(ImportingScene, ThatIsWrongIsRefusedWithPlaceAndReason) {
  EXPECT_EQ(bad_shape(R"("type": "mesh", "file": "none.obj")"), "scene.json: /shapes/0/file: no such file: none.obj");
  EXPECT_EQ(
      bad_shape(R"("type": "hull", "file": "mesh.json")"),
      "scene.json: /shapes/0/file: not a mesh of a kind that is known (.obj, .stl, .ply, .off, .dae, .gltf, .glb)");
  EXPECT_EQ(bad_shape(R"("type": "hull", "file": "flat.obj")"),
            "scene.json: /shapes/0/file: all points lie in one plane");
  EXPECT_EQ(bad_shape(R"("type": "compound", "file": "flat.obj")"), "scene.json: /shapes/0/file: the mesh is flat");
  EXPECT_EQ(bad_shape(R"("type": "mesh", "file": "ell.obj", "scale": 0)"),
            "scene.json: /shapes/0/scale: must not be 0");
  EXPECT_EQ(bad_shape(R"("type": "mesh", "file": "ell.obj", "scale": 9000)").substr(0, 8), "");
  EXPECT_EQ(bad_shape(R"("type": "hull", "file": "ell.obj", "points": [])").substr(0, 30),
            "scene.json: /shapes/0/points: ");
  EXPECT_EQ(bad_shape(R"("type": "compound", "file": "ell.obj", "decompose": {"max_hulls": 0})"),
            "scene.json: /shapes/0/decompose/max_hulls: must be at least 1, got 0");
}

TEST_F(ImportingScene, HasABodyFromAMesh) {
  const Scene scene = load(R"("generators": [{"type": "import", "file": "ell.obj", "density": 100,
    "position": [1, 0, 0]}])");
  const scenes::Expanded expanded = expand(scene);
  ASSERT_EQ(expanded.bodies.size(), 1u);
  EXPECT_NEAR(*expanded.bodies[0].traits.mass, 300, 1e-6);
  // Three unit cubes with centres at (0.5, 0.5), (1.5, 0.5) and (0.5, 1.5).
  EXPECT_NEAR(expanded.bodies[0].position[0], 1 + 2.5 / 3, 1e-9);
  EXPECT_NEAR(expanded.bodies[0].position[1], 2.5 / 3, 1e-9);
  EXPECT_NEAR(expanded.bodies[0].position[2], 0.5, 1e-9);
}

/// An L of three cubes.
TEST_F(ImportingScene, HasABodyFromAMeshInAnotherUnit) {
  const Scene scene = load(R"("generators": [{"type": "import", "file": "ell.obj", "density": 7, "scale": 20}])");
  EXPECT_NEAR(*expand(scene).bodies[0].traits.mass, 7 * 3 * 20 * 20 * 20, 1e-6);
  scratch.write("r.urdf", "<robot name='r'/>");
  EXPECT_EQ(complaint(R"("generators": [{"type": "import", "file": "r.urdf", "scale": 2}])"),
            "r.urdf: only meshes have a scale: the file is in metres");
}

/// An L that is 74 m wide. Land may be, and who gives a scale knows the unit.
TEST_F(ImportingScene, HasANoteOnAWideMeshThatMoves) {
  TriangleMesh wide = ell();
  for (Vec3& vertex : wide.vertices) vertex[1] *= 37;
  scratch.write("wide.obj", as_obj(wide));
  const auto is_noted = [&](const std::string& rest) {
    const Scene scene = load(R"("generators": [{"type": "import", "file": )" + rest + "}]");
    const auto& notes = std::get<scenes::ImportGenerator>(scene.generators[0]).notes;
    return std::count(notes.begin(), notes.end(), "the mesh is 74 m wide: a scale of 0.001 is for millimetres") == 1;
  };
  EXPECT_TRUE(is_noted(R"("wide.obj")"));
  EXPECT_FALSE(is_noted(R"("wide.obj", "static": true)"));
  EXPECT_FALSE(is_noted(R"("ell.obj", "scale": [1, 37, 1])"));
}

TEST_F(ImportingScene, CountsIndicesFromWhereItsThingsAre) {
  const Scene scene = load(R"("shapes": [{"name": "ball", "type": "sphere", "radius": 1}],
    "materials": {"ice": {"friction": 0}}, "bodies": [{"shape": "ball", "mass": 1}],
    "generators": [{"type": "import", "file": "ell.obj", "material": "ice"},
                   {"type": "import", "file": "ell.obj", "static": true}])");
  const scenes::Expanded expanded = expand(scene);
  ASSERT_EQ(expanded.bodies.size(), 3u);
  const auto& compound = std::get<scenes::CompoundShape>(expanded.shapes[expanded.bodies[1].traits.shape].value);
  for (const auto& child : compound.children)
    EXPECT_TRUE(std::holds_alternative<scenes::HullShape>(expanded.shapes[child.shape].value));
  EXPECT_EQ(expanded.bodies[1].traits.material.friction, 0);
  EXPECT_TRUE(std::holds_alternative<scenes::MeshShape>(expanded.shapes[expanded.bodies[2].traits.shape].value));
  EXPECT_EQ(expanded.bodies[2].traits.type, scenes::BodyType::fixed);
  EXPECT_EQ(pointer_of_body(expanded, 2), "/generators/1");
}

#endif

#ifdef BOXSTREAM_HAS_URDFDOM

TEST_F(ImportingScene, NamesTheBodyOrTheJointThatIsWrong) {
  const auto robot = [&](const std::string& mass, const std::string& place) {
    const std::string inertia = "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>";
    scratch.write("r.urdf", "<robot name='r'><link name='base'/><link name='fore/arm'><inertial><origin xyz='0 0 -" +
                                place + "'/><mass value='" + mass + "'/>" + inertia +
                                "<joint name='j' type='continuous'><parent link='base'/><child link='fore/arm'/>"
                                "<origin xyz='0 0 " +
                                place + "'/><axis xyz='0 1 0'/></joint></robot>");
    return complaint(R"("generators": [{"type": "import", "file": "r.urdf"}])");
  };
  EXPECT_EQ(robot("4e10", "0"),
            "r.urdf: /bodies/0/mass: must be at most 1000000000, got 40000000000 (body \"fore/arm\")");
  // A body at the origin, on a joint that is far off.
  const std::string far = robot("4", "3e5");
  EXPECT_TRUE(far.starts_with("r.urdf: /joints/0/pivot/1: must be at most 100000, got ")) << far;
  EXPECT_TRUE(far.ends_with(" (joint of body \"fore/arm\")")) << far;
}

#endif

TEST_F(ImportingScene, OfAnotherKindOfFileIsRefused) {
  scratch.write("robot.sdf", "<sdf/>");
  EXPECT_EQ(
      complaint(R"("generators": [{"type": "import", "file": "robot.sdf"}])"),
      "robot.sdf: not a kind of file that is imported (.urdf, .bullet, .obj, .stl, .ply, .off, .dae, .gltf, .glb)");
}

}  // namespace
}  // namespace boxstream::import_test
