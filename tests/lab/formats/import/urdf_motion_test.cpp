// SPDX-License-Identifier: MIT
// How imported robots move.
#include "formats/scene_json/load_scene.hpp"
#include "simulation/run/simulation.hpp"
#include "urdf_robot.hpp"

namespace boxstream::import_test {
namespace {

TEST(Urdf, AnArmWhoseLinksAreTurnedAgainstEachOtherHoldsItsPose) {
  // Three bars, each joint frame turned by a quarter against the last, limits of 10 degrees: it must not fold.
  std::string text = "<robot name=\"r\"><link name=\"world\"/>";
  for (int i = 0; i < 3; ++i) {
    const std::string name = "bar" + std::to_string(i), above = i == 0 ? "world" : "bar" + std::to_string(i - 1);
    text += "<link name=\"" + name +
            "\"><inertial><origin xyz=\"0.2 0 0\" rpy=\"0.3 0.4 0.5\"/><mass value=\"1\"/>"
            "<inertia ixx=\"0.01\" ixy=\"0\" ixz=\"0\" iyy=\"0.02\" iyz=\"0\" izz=\"0.02\"/></inertial>"
            "<collision><origin xyz=\"0.2 0 0\"/><geometry><box size=\"0.3 0.05 0.05\"/></geometry></collision></link>"
            "<joint name=\"j" +
            std::to_string(i) + "\" type=\"revolute\"><parent link=\"" + above + "\"/><child link=\"" + name +
            "\"/><origin xyz=\"0.4 0 0\" rpy=\"1.5708 0 1.5708\"/><axis xyz=\"0 0 1\"/>"
            "<limit lower=\"-0.17\" upper=\"0.17\" effort=\"100\" velocity=\"0\"/></joint>";
  }
  const ScratchDirectory scratch;
  scratch.write("r.urdf", text + "</robot>");
  scenes::Simulation simulation(
      scenes::parse_scene(
          R"({"format": 1, "meta": {"name": "urdf", "about": "imported"}, "time": {"dt": 0.01},
  "world": {"bounds": {"min": [-5, -5, -5], "max": [5, 5, 5]}}, "solver": {"iterations": 50},
  "generators": [{"type": "import", "file": "r.urdf", "hold": true}]})",
          scratch.file("scene.json")),
      "boxstream");
  std::vector<btVector3> start;
  for (const btCollisionObject* object : simulation.objects()) start.push_back(object->getWorldTransform().getOrigin());
  for (int step = 0; step < 200; ++step) simulation.step();
  for (std::size_t i = 0; i < start.size(); ++i)
    EXPECT_LT(double{simulation.objects()[i]->getWorldTransform().getOrigin().distance(start[i])}, 0.01) << i;
}

/// The post and the bar, written by hand as a scene.
const char* const by_hand = R"({"format": 1, "meta": {"name": "hand", "about": "by hand"}, "time": {"dt": 0.01},
  "world": {"bounds": {"min": [-5, -5, -5], "max": [5, 5, 5]}},
  "shapes": [{"name": "post", "type": "box", "half_extents": [0.1, 0.1, 1]},
             {"name": "bar", "type": "box", "half_extents": [0.5, 0.05, 0.05]}],
  "bodies": [{"name": "post", "shape": "post", "type": "static", "position": [0, 1, 0],
              "rotation": {"axis": [-1, 0, 0], "degrees": 90}},
             {"name": "bar", "shape": "bar", "mass": 2, "inertia": [1, 1, 1],
              "position": [0.5, 2.1, 0], "rotation": {"axis": [-1, 0, 0], "degrees": 90}}],
  "joints": [{"type": "hinge", "a": "bar", "pivot": [0, 2.1, 0], "axis": [0, 0, -1],
              "limits": [-28.64788975654116, 57.29577951308232]}],
  "exclusions": [["post", "bar"]]})";

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

}  // namespace
}  // namespace boxstream::import_test
