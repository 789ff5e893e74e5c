// SPDX-License-Identifier: MIT
// That bodies in a world balance about their centres of mass, and are where their scenes describe them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include <btBulletDynamicsCommon.h>

#include "formats/scene_json/load_scene.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::scenes {
namespace {

std::string scene_of(const std::string& shapes, const std::string& bodies, int steps, const std::string& more = "") {
  return R"({"format": 1, "meta": {"name": "x", "about": "x", "source": "x"}, "time": {"dt": 0.004, "steps": )" +
         std::to_string(steps) + R"(}, "world": {"bounds": {"min": [-9, -9, -9], "max": [9, 9, 9]})" + more +
         R"(}, "shapes": [)" + shapes + R"(], "bodies": [)" + bodies + "]}";
}

Scene parse(const std::string& text) {
  return parse_scene(text, "balance.json");
}

constexpr const char* no_gravity = R"(, "gravity": [0, 0, 0])";
constexpr const char* lopsided =
    R"({"name": "heavy", "type": "box", "half_extents": [0.4, 0.3, 0.2]},
       {"name": "arm", "type": "box", "half_extents": [0.1, 0.6, 0.1]},
       {"name": "it", "type": "compound", "children": [{"shape": "heavy", "position": [0.5, 0.1, 0]},
        {"shape": "arm", "position": [-0.3, 0.4, 0.2], "rotation": {"axis": [1, 1, 0], "degrees": 40}}]})";

TEST(Balance, ADescribedPlaceIsThePoseAtTheStart) {
  const Scene scene = parse(
      scene_of(std::string(lopsided) + R"(, {"name": "cone", "type": "cone", "radius": 0.3, "height": 0.8},
        {"name": "hull", "type": "hull", "points": [[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]]})",
               R"({"shape": "it", "density": 10, "position": [1, 2, 3], "rotation": {"axis": [1, 2, 3], "degrees": 70}},
         {"shape": "cone", "density": 10, "position": [-4, 2, 3], "rotation": {"axis": [1, 0, 3], "degrees": 30}},
         {"shape": "hull", "density": 10, "position": [4, -2, 1], "rotation": {"axis": [0, 2, 3], "degrees": 110}})",
               1, no_gravity));
  const Simulation simulation(scene, "boxstream");
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const btTransform pose = simulation.pose(i);
    const btQuaternion turn = pose.getRotation();
    double same = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_NEAR(pose.getOrigin()[static_cast<int>(d)], scene.bodies[i].position[d], 1e-6);
      same += double{turn[static_cast<int>(d)]} * scene.bodies[i].rotation[d];
    }
    same += double{turn.w()} * scene.bodies[i].rotation[3];
    EXPECT_NEAR(std::abs(same), 1, 1e-6);
    EXPECT_NE(simulation.objects()[i]->getWorldTransform().getOrigin(), pose.getOrigin());
  }
}

// Spun about a principal axis through its centre of mass a body keeps the centre where it is; its origin goes round.
TEST(Balance, AFreeBodyTurnsAboutItsCentreOfMass) {
  const Scene scene =
      parse(scene_of(R"({"name": "cone", "type": "cone", "radius": 0.3, "height": 0.8})",
                     R"({"shape": "cone", "density": 10, "spin": [0, 0, 2], "gyro": false})", 500, no_gravity));
  Simulation simulation(scene, "boxstream");
  for (int i = 0; i < 500; ++i) simulation.advance();
  const btVector3 centre = simulation.pose(0) * btVector3(0, -0.2F, 0);
  EXPECT_NEAR(centre.y(), -0.2, 1e-5);
  EXPECT_NEAR(centre.x(), 0, 1e-5);
  EXPECT_GT(simulation.pose(0).getOrigin().distance(btVector3(0, 0, 0)), 0.1);
}

// A cone that stands on the edge of its base falls back onto it as long as its centre of mass, a quarter up, is within.
TEST(Balance, AConeOnItsEdgeFallsToTheSideOfItsCentreOfMass) {
  const double r = 0.4, h = 1.2, balance = std::atan2(r, h / 4) * 180 / std::numbers::pi;
  for (const double lean : {-4.0, 4.0}) {
    const double angle = (balance + lean) * std::numbers::pi / 180;
    const double height = h / 2 * std::cos(angle) + r * std::sin(angle);
    Scene scene = parse(scene_of(
        R"({"name": "c", "type": "cone", "radius": 0.4, "height": 1.2}, {"name": "g", "type": "box", "half_extents": [9, 1, 9]})",
        R"({"shape": "g", "type": "static", "position": [0, -1, 0]}, {"shape": "c", "density": 700, "position": [0, )" +
            std::to_string(height) + R"(, 0], "rotation": {"axis": [0, 0, 1], "degrees": )" +
            std::to_string(balance + lean) + "}}",
        1500));
    for (Body& body : scene.bodies) body.traits.material.friction = 1;
    Simulation simulation(scene, "boxstream");
    for (int i = 0; i < 1500; ++i) simulation.advance();
    const double up = double{simulation.pose(1).getBasis()[1][1]};
    if (lean < 0)
      EXPECT_NEAR(up, 1, 1e-3);
    else
      EXPECT_LT(up, 0.5);
  }
}

// Hung by a ball joint at a corner, a body comes to rest with its centre of mass below the joint.
TEST(Balance, AHungBodyHangsByItsCentreOfMass) {
  const Scene scene =
      parse(R"({"format": 1, "meta": {"name": "x", "about": "x", "source": "x"}, "time": {"dt": 0.016, "steps": 2400},
    "world": {"bounds": {"min": [-9, -9, -9], "max": [9, 9, 9]}},
    "shapes": [{"name": "hull", "type": "hull", "points": [[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]]}],
    "bodies": [{"name": "it", "shape": "hull", "density": 10, "linear_damping": 0.4, "angular_damping": 0.4, "sleep": false}],
    "joints": [{"type": "ball", "a": "it", "pivot": [0, 2, 0]}]})");
  Simulation simulation(scene, "boxstream");
  for (int i = 0; i < 2400; ++i) simulation.advance();
  const btVector3 centre = simulation.pose(0) * btVector3(0.25F, 0.5F, 0.75F);
  const btVector3 joint = simulation.pose(0) * btVector3(0, 2, 0);
  EXPECT_NEAR(joint.distance(btVector3(0, 2, 0)), 0, 1e-3);
  EXPECT_NEAR(centre.x(), 0, 0.02);
  EXPECT_NEAR(centre.z(), 0, 0.02);
  EXPECT_LT(centre.y(), joint.y() - 1);
}

}  // namespace
}  // namespace boxstream::scenes
