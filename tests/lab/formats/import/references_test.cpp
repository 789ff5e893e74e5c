// SPDX-License-Identifier: MIT
// Whatever a scene names lies in its folder or below it: every kind of reference with every kind of name.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/import/import_file.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/scene_error.hpp"
#include "scratch_directory.hpp"

namespace boxstream::import_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A scene's folder, and beside it one that is none of its business. Both have the same files.
class References : public testing::Test {
 protected:
  References() {
    for (const char* const folder : {"home/sub", "away"}) {
      fs::create_directories(top.file(folder));
      const std::string in = std::string(folder) + "/";
      top.write(in + "net.json", R"({"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "triangles": [[0, 1, 2]]})");
      top.write(in + "solid.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
      top.write(in + "robot.urdf", robot("solid.obj"));
    }
    fs::create_directory_symlink("../away", top.file("home/link"));
    fs::create_directory_symlink("sub", top.file("home/near"));
    for (const char* const name : {"net.json", "solid.obj", "robot.urdf"})
      fs::create_symlink(std::string("../away/") + name, top.file(std::string("home/linked_") + name));
  }

  static std::string robot(const std::string& mesh) {
    return R"(<robot name="r"><link name="l"><collision><geometry><mesh filename=")" + mesh +
           R"("/></geometry></collision><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0"
           izz="1"/></inertial></link></robot>)";
  }

  /// Why the scene does not load; empty: it does.
  std::string complaint(const char* block, const json& item) const {
    const json scene{{"format", 1},
                     {"meta", {{"name", "n"}, {"about", "a"}}},
                     {"time", {{"dt", 0.01}}},
                     {"world", {{"bounds", {{"min", {-5, -5, -5}}, {"max", {5, 5, 5}}}}}},
                     {block, {item}}};
    try {
      scenes::load_scene(top.write("home/scene.json", scene.dump()));
      return {};
    } catch (const scenes::SceneError& error) {
      return error.what();
    }
  }

  /// `complaint_of(name)` of a file that both folders have.
  template <class ComplaintOf>
  void expect_confined(const std::string& file, const ComplaintOf& complaint_of) {
    for (const std::string& inside :
         {"sub/" + file, "./sub/../sub/" + file, "near/" + file, top.file("home/sub/" + file)})
      EXPECT_EQ(complaint_of(inside), "") << inside;
    for (const std::string& outside :
         {"../away/" + file, "sub/../../away/" + file, "link/" + file, top.file("away/" + file),
          top.file("home/../away/" + file), "linked_" + (file.empty() ? "net.json" : file), std::string("/etc/passwd"),
          std::string("../none_there")}) {
      const std::string said = complaint_of(outside);
      EXPECT_NE(said.find("outside of the scene's folder"), std::string::npos) << outside << ": " << said;
      EXPECT_EQ(said.find('\n'), std::string::npos);
    }
  }

  tool_test::ScratchDirectory top;
};

TEST_F(References, OfAMeshInJson) {
  expect_confined("net.json", [&](const std::string& file) {
    return complaint("shapes", {{"name", "s"}, {"type", "mesh"}, {"file", file}});
  });
}

#ifdef BOXSTREAM_HAS_ASSIMP
TEST_F(References, OfShapesFromOtherPrograms) {
  for (const char* const type : {"mesh", "hull", "compound"}) {
    SCOPED_TRACE(type);
    expect_confined("solid.obj", [&](const std::string& file) {
      // By its name alone a file is a mesh.
      const std::string name = file.ends_with(".obj") ? file : file + ".obj";
      return complaint("shapes", {{"name", "s"}, {"type", type}, {"file", name}});
    });
  }
}

TEST_F(References, OfAnImportedMesh) {
  expect_confined("solid.obj", [&](const std::string& file) {
    return complaint("generators", {{"type", "import"}, {"file", file}});
  });
}
#endif

#if defined(BOXSTREAM_HAS_URDFDOM) && defined(BOXSTREAM_HAS_ASSIMP)
TEST_F(References, OfAnImportedRobot) {
  expect_confined("robot.urdf", [&](const std::string& file) {
    return complaint("generators", {{"type", "import"}, {"file", file}});
  });
}

TEST_F(References, OfARobotsMeshes) {
  const auto of_robot = [&](const std::string& mesh, const std::vector<std::string>& packages = {}) {
    top.write("home/robot.urdf", robot(mesh));
    return complaint("generators", {{"type", "import"}, {"file", "robot.urdf"}, {"packages", packages}});
  };
  expect_confined("solid.obj", of_robot);
  for (const char* const scheme : {"file://", "package://sub/../../"}) {
    const std::string outside = scheme + (scheme[0] == 'f' ? top.file("away/solid.obj") : "away/solid.obj");
    EXPECT_NE(of_robot(outside), "") << outside;
  }
  EXPECT_EQ(of_robot("file://" + top.file("home/sub/solid.obj")), "");
  EXPECT_EQ(of_robot("package://sub/solid.obj"), "");
  EXPECT_EQ(of_robot("package://any/solid.obj", {"sub"}), "");
  // A package above the scene's folder, or by a link out of it: there is none, whatever is there.
  for (const std::string package : {"package://away/", "package://link/", "package://sub/../../away/"})
    for (const std::string file : {"solid.obj", "nothing.obj"})
      EXPECT_NE(of_robot(package + file).find(package + file + ": no such file; searched "), std::string::npos) << file;
}

TEST_F(References, OfFoldersOfPackages) {
  expect_confined("", [&](const std::string& folder) {
    top.write("home/robot.urdf", robot("sub/solid.obj"));
    return complaint("generators", {{"type", "import"}, {"file", "robot.urdf"}, {"packages", {folder}}});
  });
}

/// A file that its user names has its meshes where they are.
TEST_F(References, OfARobotOnTheCommandLine) {
  imports::ImportOptions options;
  EXPECT_NE(imports::import_file(top.write("home/robot.urdf", robot("../away/solid.obj")), options), "");
  options.within = top.file("home");
  EXPECT_THROW(imports::import_file(top.file("home/robot.urdf"), options), scenes::SceneError);
}
#endif

}  // namespace
}  // namespace boxstream::import_test
