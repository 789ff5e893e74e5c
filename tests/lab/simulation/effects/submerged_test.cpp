// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include <btBulletDynamicsCommon.h>

#include "formats/scene_model/random.hpp"
#include "gallery.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/submerged.hpp"
#include "simulation/run/simulation.hpp"

// Bodies in water: what of them is under, and how they float.
namespace boxstream::effects_test {
namespace {

using scenes::Displacement;
using scenes::Scene;
using scenes::Shape;
using scenes::ShapeSet;
using scenes::Simulation;
using scenes::Vec3;
using scenes::Volume;

constexpr double pi = std::numbers::pi;

const scenes::Quat straight{0, 0, 0, 1};

struct Solid {
  const char* name;
  std::vector<Shape> shapes;  // the last one is it
  /// Whether a point, from its origin and along its axes, is inside.
  bool (*has)(const Vec3& p);
};

std::vector<Solid> solids() {
  using namespace scenes;
  return {
      {"ball", {{"", SphereShape{0.7}}}, [](const Vec3& p) { return std::hypot(p[0], p[1], p[2]) < 0.7; }},
      {"box",
       {{"", BoxShape{{0.3, 0.8, 0.5}}}},
       [](const Vec3& p) { return std::abs(p[0]) < 0.3 && std::abs(p[1]) < 0.8 && std::abs(p[2]) < 0.5; }},
      {"cylinder",
       {{"", CylinderShape{0.4, 1.2}}},
       [](const Vec3& p) { return std::hypot(p[0], p[2]) < 0.4 && std::abs(p[1]) < 0.6; }},
      {"capsule",
       {{"", CapsuleShape{0.35, 0.9}}},
       [](const Vec3& p) { return std::hypot(p[0], p[1] - std::clamp(p[1], -0.45, 0.45), p[2]) < 0.35; }},
      {"cone",
       {{"", ConeShape{0.6, 1.4}}},
       [](const Vec3& p) { return std::abs(p[1]) < 0.7 && std::hypot(p[0], p[2]) < 0.6 * (0.7 - p[1]) / 1.4; }},
      {"hull",
       {{"", HullShape{{{0.8, -0.2, 0}, {-0.4, -0.2, 0.7}, {-0.4, -0.2, -0.7}, {0, 0.6, 0}}}}},
       [](const Vec3& p) {
         // A tetrahedron: above its base, and inside three faces through the tip.
         const double share = (0.6 - p[1]) / 0.8;
         if (!(p[1] > -0.2) || !(share > 0)) return false;
         const double x = p[0] / share, z = p[2] / share;
         return x > -0.4 && 0.7 * x + 1.2 * z < 0.56 && 0.7 * x - 1.2 * z < 0.56;
       }},
      {"compound",
       {{"", BoxShape{{0.2, 0.3, 0.1}}},
        {"", CompoundShape{{{0, {0.5, 0, 0}, straight}, {0, {-0.5, 0.1, 0}, straight}}}}},
       [](const Vec3& p) {
         return std::abs(p[2]) < 0.1 && ((std::abs(p[0] - 0.5) < 0.2 && std::abs(p[1]) < 0.3) ||
                                         (std::abs(p[0] + 0.5) < 0.2 && std::abs(p[1] - 0.1) < 0.3));
       }},
  };
}

/// Counts points, one somewhere in each cell of a lattice.
Volume counted(const Solid& solid, const btTransform& body, double level, const btTransform& frame) {
  Volume sum;
  scenes::Random random(11);
  constexpr int side = 110;
  constexpr double cell = 2.4 / side;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < side; ++k) {
        const Vec3 p{(i + random.unit()) * cell - 1.2, (j + random.unit()) * cell - 1.2,
                     (k + random.unit()) * cell - 1.2};
        if (!solid.has(p)) continue;
        const btVector3 in_body = frame * scenes::vector(p);
        const btVector3 turned = body.getBasis() * in_body;
        if (double{turned.y()} + double{body.getOrigin().y()} < level)
          sum.add(cell * cell * cell, {turned.x(), turned.y(), turned.z()});
      }
  return sum;
}

TEST(Submerged, VolumeAndItsCentreAreThoseOfThePointsUnderTheLevel) {
  scenes::Random random(7);
  for (const Solid& solid : solids()) {
    ShapeSet shapes(solid.shapes);
    for (int i = 0; i < 12; ++i) {
      const btTransform frame(btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(i % 3)),
                              btVector3(btScalar(0.1 * (i % 3)), 0, btScalar(-0.05 * (i % 2))));
      const Displacement displacement(shapes, solid.shapes.size() - 1, frame);
      std::array<btScalar, 6> numbers;  // in this order with any compiler
      for (btScalar& number : numbers) number = scenes::real(random.range(-1, 1));
      const auto& [x, y, z, w, height, above] = numbers;
      // Upright, lying, and turned at random.
      const btQuaternion turn = i == 0   ? btQuaternion(0, 0, 0, 1)
                                : i == 1 ? btQuaternion(btVector3(0, 0, 1), btScalar(pi / 2))
                                         : btQuaternion(x, y, z, w).normalized();
      const btTransform body(turn, btVector3(3, height, -5));
      const double level = double{body.getOrigin().y()} + 0.6 * double{above};
      const Volume exact = displacement.below(body, level), rough = counted(solid, body, level, frame);
      const double whole = displacement.volume();
      EXPECT_NEAR(exact.size, rough.size, 0.003 * whole) << solid.name << ' ' << i;
      for (std::size_t d = 0; d < 3; ++d)
        EXPECT_NEAR(exact.moment[d], rough.moment[d], 0.003 * whole) << solid.name << ' ' << i << ' ' << d;
    }
  }
}

TEST(Submerged, PartsAndTheirRestAreTheWhole) {
  for (const Solid& solid : solids()) {
    ShapeSet shapes(solid.shapes);
    const btTransform upside(btQuaternion(btVector3(1, 0, 0), btScalar(pi)));
    const Displacement up(shapes, solid.shapes.size() - 1, btTransform::getIdentity()),
        down(shapes, solid.shapes.size() - 1, upside);
    const btTransform body(btQuaternion(btVector3(2, 1, 0).normalized(), btScalar(0.8)));
    const btTransform turned(body.getBasis() * upside.getBasis());
    for (const double level : {-0.5, -0.2, 0.0, 0.1, 0.4}) {
      // Seen upside down, what was above is below.
      const btTransform mirrored = upside * body;
      const double below = up.below(body, level).size, above = up.below(mirrored, -level).size;
      EXPECT_NEAR(below + above, up.volume(), 2e-3 * up.volume()) << solid.name << ' ' << level;
      EXPECT_NEAR(down.below(body, level).size, up.below(turned, level).size, 1e-5) << solid.name;
    }
  }
}

/// One body in still water with its surface at y = 0, let go at a place.
Scene afloat(scenes::ShapeValue shape, double density, double drag) {
  Scene scene = exhibit("buoyancy");
  scene.time.dt = 1.0 / 120;
  scene.world.gravity = {0, -9.81, 0};
  scene.shapes = {{"floater", std::move(shape)}};
  scene.bodies.resize(1);
  scene.generators.clear();
  scene.joints.clear();
  scene.expect = {};
  scene.fields = {scenes::BuoyancyField{0, 1000, drag}};
  scenes::Body& body = scene.bodies[0];
  body = {};
  body.traits.density = density;
  body.traits.sleep = false;
  return scene;
}

/// As the scene describes it.
btTransform pose(const Simulation& simulation) {
  return simulation.pose(0);
}

void run(Simulation& simulation, double seconds) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / simulation.scene().time.dt)); ++i) simulation.advance();
}

scenes::Quat about_z(double degrees) {
  return {0, 0, std::sin(degrees * pi / 360), std::cos(degrees * pi / 360)};
}

TEST(Buoyancy, LaysAPlankDownThatStoodNearlyUpright) {
  Scene scene = afloat(scenes::BoxShape{{0.9, 0.08, 0.25}}, 450, 1);
  scene.bodies[0].rotation = about_z(80);
  Simulation simulation(scene, "boxstream");
  run(simulation, 40);
  EXPECT_NEAR(std::abs(pose(simulation).getBasis().getColumn(1).y()), 1, 1e-3);
  EXPECT_NEAR(pose(simulation).getOrigin().y(), 0.08 - 0.16 * 0.45, 1e-3);
}

TEST(Buoyancy, KeepsAShortCylinderUprightAndLaysALongOneDown) {
  // Upright it is steady while radius / height > sqrt(2 s (1 - s)), of a share s of the water's density.
  const double steady = std::sqrt(2 * 0.5 * 0.5);
  for (const bool upright : {true, false}) {
    const double height = 1, radius = height * steady * (upright ? 1.1 : 0.9);
    Scene scene = afloat(scenes::CylinderShape{radius, height}, 500, 1);
    scene.bodies[0].rotation = about_z(4);
    Simulation simulation(scene, "boxstream");
    run(simulation, 60);
    const double lean = std::abs(double{pose(simulation).getBasis().getColumn(1).y()});
    if (upright) {
      EXPECT_GT(lean, 0.9999);
      EXPECT_NEAR(pose(simulation).getOrigin().y(), 0, 1e-3);
    } else {
      EXPECT_LT(lean, 0.95);
    }
  }
}

/// A barge that leans by forty degrees.
TEST(Buoyancy, RightsABoat) {
  Scene scene = afloat(scenes::BoxShape{{1, 0.3, 0.4}}, 400, 1);
  scene.bodies[0].rotation = {std::sin(0.35), 0, 0, std::cos(0.35)};
  Simulation simulation(scene, "boxstream");
  run(simulation, 40);
  EXPECT_GT(pose(simulation).getBasis().getColumn(1).y(), 0.999);
}

/// Time of the third crossing of a mean less the first: a period.
template <class Value>
double period(Simulation& simulation, Value value) {
  std::vector<double> crossings;
  double before = value();
  for (int step = 1; crossings.size() < 3 && step < 100'000; ++step) {
    simulation.advance();
    const double now = value();
    if ((before < 0) != (now < 0))
      crossings.push_back((step - 1 + before / (before - now)) * simulation.scene().time.dt);
    before = now;
  }
  return crossings.at(2) - crossings.at(0);
}

TEST(Buoyancy, BobsAndRollsAtTheRateOfItsWaterplane) {
  // A box of half the density of water floats half under. Down it is pressed as by a spring of area times weight of
  // water; aside as by one of metacentric height times weight.
  const Vec3 half{0.5, 0.15, 0.6};
  const double mass = 8 * half[0] * half[1] * half[2] * 500;
  {
    Scene scene = afloat(scenes::BoxShape{half}, 500, 0);
    scene.bodies[0].position = {0, 0.02, 0};
    Simulation simulation(scene, "boxstream");
    const double rate = std::sqrt(1000 * 9.81 * 4 * half[0] * half[2] / mass);
    EXPECT_NEAR(period(simulation, [&] { return double{pose(simulation).getOrigin().y()}; }), 2 * pi / rate,
                0.005 * 2 * pi / rate);
  }
  Scene scene = afloat(scenes::BoxShape{half}, 500, 0);
  scene.bodies[0].rotation = about_z(2);
  Simulation simulation(scene, "boxstream");
  const double moment = mass / 3 * (half[0] * half[0] + half[1] * half[1]);
  const double metacentre = (2 * half[2] * std::pow(2 * half[0], 3) / 12) / (mass / 1000) - half[1] / 2;
  const double rate = std::sqrt(mass * 9.81 * metacentre / moment);
  const auto lean = [&] { return double{pose(simulation).getBasis().getColumn(1).x()}; };
  EXPECT_NEAR(period(simulation, lean), 2 * pi / rate, 0.01 * 2 * pi / rate);
}

TEST(Buoyancy, FloatsEachShapeAsDeepAsItsVolumeSays) {
  for (const Solid& solid : solids()) {
    if (std::string(solid.name) == "compound") continue;
    Scene scene = afloat(solid.shapes[0].value, 600, 2);
    Simulation simulation(scene, "boxstream");
    run(simulation, 60);
    ShapeSet shapes(solid.shapes);
    const Displacement displacement(shapes, 0, btTransform::getIdentity());
    const double under = displacement.below(pose(simulation), 0).size;
    EXPECT_NEAR(under / displacement.volume(), 0.6, 0.005) << solid.name;
  }
}

}  // namespace
}  // namespace boxstream::effects_test
