// SPDX-License-Identifier: MIT
// That bodies slide as Coulomb says, with all of their corners on the ground.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include "formats/scene_json/load_scene.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::scenes {
namespace {

constexpr double friction = 0.4, step = 1.0 / 60;

/// A body of half a height of `size`, on ground that leans by an angle: gravity is turned, not the ground.
struct Slide {
  std::string name, shape, ground;
  double size = 1;
};

std::string box(double x, double y, double z) {
  return fmt::format(R"("type": "box", "half_extents": [{}, {}, {}])", x, y, z);
}

std::string hull(double s) {
  std::string corners;
  for (const double x : {-s, s})
    for (const double y : {-s, s})
      for (const double z : {-s, s}) corners += fmt::format("{}[{}, {}, {}]", corners.empty() ? "" : ", ", x, y, z);
  return fmt::format(R"("type": "hull", "points": [{}])", corners);
}

std::vector<Slide> slides() {
  const std::string floor = box(100, 1, 100);
  return {{"Cube", box(.4, .4, .4), floor, .4},
          {"SmallCube", box(.1, .1, .1), floor, .1},
          {"LargeCube", box(3, 3, 3), floor, 3},
          {"Slab", box(.6, .1, .3), floor, .1},
          {"Hull", hull(.4), floor, .4},
          {"Cylinder", R"("type": "cylinder", "radius": 0.8, "height": 0.5)", floor, .25}};
}

/// Where it is in the end, and how it turns.
struct Outcome {
  btVector3 place, spin;
};

Outcome run(const Slide& slide, double degrees, double speed, double heading, int steps) {
  const double lean = degrees * M_PI / 180, way = heading * M_PI / 180;
  Simulation simulation(
      parse_scene(
          fmt::format(
              R"({{"format": 1, "meta": {{"name": "x", "about": "x", "source": "x"}}, "time": {{"dt": {}, "steps": {}}},
          "materials": {{"one": {{"friction": 1}}, "rough": {{"friction": {}}}}},
          "world": {{"gravity": [{}, {}, 0], "bounds": {{"min": [-200, -200, -200], "max": [200, 200, 200]}}}},
          "shapes": [{{"name": "g", {}}}, {{"name": "it", {}}}],
          "bodies": [{{"shape": "g", "type": "static", "position": [0, {}, 0], "material": "one"}},
           {{"shape": "it", "mass": 2, "position": [0, {}, 0], "velocity": [{}, 0, {}], "material": "rough",
             "sleep": false}}]}})",
              step, steps, friction, 9.81 * std::sin(lean), -9.81 * std::cos(lean), slide.ground, slide.shape, -1,
              slide.size, speed * std::cos(way), speed * std::sin(way)),
          "sliding"),
      "boxstream");
  for (int i = 0; i < steps; ++i) simulation.advance();
  const btRigidBody& body = *btRigidBody::upcast(simulation.objects()[1]);
  return {body.getWorldTransform().getOrigin(), body.getAngularVelocity()};
}

class Slides : public testing::TestWithParam<Slide> {};

// Of the sum of two forces that are nearly as large, a hundredth is a thousandth of each.
TEST_P(Slides, DownASlopeThatIsALittleSteeperThanItsFrictionHolds) {
  const double degrees = std::atan(friction) * 180 / M_PI + 2, lean = degrees * M_PI / 180;
  const int steps = 150;
  const btVector3 at = run(GetParam(), degrees, 0, 0, steps).place;
  const double pull = 9.81 * (std::sin(lean) - friction * std::cos(lean));
  // Speeds are those at the ends of steps.
  const double way = pull * step * step * steps * (steps + 1) / 2;
  EXPECT_NEAR(at.x(), way, 0.01 * way);
  EXPECT_NEAR(at.z(), 0, 0.01 * way);
}

TEST_P(Slides, AsFarAsItsSpeedBearsIt) {
  for (const double heading : {0.0, 25.0}) {
    const btVector3 at = run(GetParam(), 0, 6, heading, 180).place;
    const double way = 36 / (2 * friction * 9.81) - 3 * step;
    EXPECT_NEAR(std::hypot(at.x(), at.z()), way, 0.01 * way) << heading;
    EXPECT_NEAR(std::atan2(at.z(), at.x()) * 180 / M_PI, heading, 0.5);
  }
}

TEST_P(Slides, WithAllOfItsCornersOnTheGround) {
  const Outcome outcome = run(GetParam(), 0, 6, 10, 40);
  EXPECT_NEAR(outcome.place.y(), GetParam().size, 0.002 * GetParam().size);
  EXPECT_LT(outcome.spin.length(), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Of, Slides, testing::ValuesIn(slides()), [](const auto& slide) { return slide.param.name; });

TEST(Sliding, NotAtAllOnASlopeThatItsFrictionHolds) {
  for (const Slide& slide : slides()) {
    const btVector3 at = run(slide, std::atan(friction) * 180 / M_PI - 2, 0, 0, 300).place;
    EXPECT_LT(std::hypot(at.x(), at.z()), 0.01) << slide.name;
  }
}

}  // namespace
}  // namespace boxstream::scenes
