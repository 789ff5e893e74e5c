// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <btBulletDynamicsCommon.h>

#include "formats/scene_model/names.hpp"
#include "gallery.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::effects_test {
namespace {

using scenes::Scene;
using scenes::Simulation;

btVector3 place(const Simulation& simulation, std::size_t index = 0) {
  return simulation.objects()[index]->getWorldTransform().getOrigin();
}

void run(Simulation& simulation, double seconds) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / simulation.scene().time.dt)); ++i) simulation.advance();
}

/// A cube of 1 m on a belt.
Scene belt() {
  Scene scene = exhibit("conveyors");
  scene.shapes[0].value = scenes::BoxShape{{0.5, 0.5, 0.5}};
  return scene;
}

/// Turns belt and box together about z, and gravity stays: a slope.
Scene slope(double degrees) {
  Scene scene = belt();
  const double half = degrees * std::numbers::pi / 360, c = std::cos(2 * half), s = std::sin(2 * half);
  for (scenes::Body& body : scene.bodies) {
    body.rotation = {0, 0, std::sin(half), std::cos(half)};
    const double y = body.position[1];
    body.position = {-s * y, c * y, 0};
  }
  return scene;
}

TEST(Conveyor, AcceleratesByFrictionUntilNothingSlips) {
  for (const char* const broadphase : {"boxstream", "dbvt"}) {
    Simulation simulation(belt(), broadphase);
    run(simulation, 3);
    // 0.25 g until it has the velocity of 1 m/s of the belt.
    const double slipped = 1 / (2 * 0.25 * 9.81);
    EXPECT_NEAR(place(simulation).x(), 3 - slipped, 0.02);
    // Friction along the way is solved before friction across it, which leaves a little; alone, it leaves none.
    EXPECT_NEAR(place(simulation).z(), 0, 5e-3);
    EXPECT_NEAR(place(simulation).y(), 0.5, 0.02);
    EXPECT_EQ(place(simulation, 1), btVector3(0, -1, 0)) << "the belt stays";
    Scene along = belt();
    along.solver.friction_directions = scenes::FrictionDirections::one;
    Simulation straight(along, broadphase);
    run(straight, 3);
    EXPECT_NEAR(place(straight).z(), 0, 1e-3);
  }
}

TEST(Conveyor, CarriesUphillAlongItsOwnAxes) {
  Simulation simulation(slope(10), "boxstream");
  run(simulation, 3);
  const double angle = 10 * std::numbers::pi / 180;
  // Friction less what gravity takes.
  const double slipped = 1 / (2 * 9.81 * (0.25 * std::cos(angle) - std::sin(angle)));
  const double along = place(simulation).x() * std::cos(angle) + place(simulation).y() * std::sin(angle);
  EXPECT_NEAR(along, 3 - slipped, 0.05);
}

TEST(Conveyor, RollsABallWithTwoSeventhsOfItsSpeed) {
  Simulation simulation(exhibit("conveyors"), "boxstream");
  run(simulation, 1);
  const double before = place(simulation).x();
  run(simulation, 1);
  EXPECT_NEAR(place(simulation).x() - before, 2.0 / 7, 0.01);
}

/// Friction acts at each bounce. The first one makes a ball roll: two sevenths of the belt's speed, the rest is spin.
TEST(Conveyor, CarriesWhatBouncesOnContact) {
  Scene scene = exhibit("conveyors");
  scene.time.dt = 1e-3;
  scene.solver.bounces = scenes::Bounces::on_contact;
  scene.bodies[1].surface_velocity = {3, 0, 0};
  for (scenes::Body& body : scene.bodies) body.traits.material.friction = body.traits.material.restitution = 1;
  scene.bodies[0].traits.material.restitution = 0.8;
  scene.bodies[0].position[1] += 0.6;
  Simulation simulation(scene, "boxstream");
  for (int i = 0; i < 500; ++i) simulation.advance(true);
  const btRigidBody& ball = *btRigidBody::upcast(simulation.objects()[0]);
  const double radius = std::get<scenes::SphereShape>(scene.shapes[0].value).radius;
  EXPECT_NEAR(ball.getLinearVelocity().x(), 3 * 2 / 7.0, 0.005);
  EXPECT_NEAR(ball.getAngularVelocity().z(), 3 * 5 / 7.0 / radius, 0.01);
  const scenes::EnergyBalance balance = simulation.energy_balance();
  EXPECT_NEAR(balance.work.surfaces, *scene.bodies[0].traits.mass * 3 * 3 * 2 / 7.0, 0.01);
  EXPECT_FALSE(balance.worst);
}

TEST(Conveyor, CarriesNothingWithoutFriction) {
  Scene scene = belt();
  scene.bodies[0].traits.material.friction = 0;
  Simulation simulation(scene, "boxstream");
  EXPECT_FALSE(effects::is_on(simulation.plan(), effects::conveyors));
  run(simulation, 1);
  EXPECT_NEAR(place(simulation).x(), 0, 1e-6);
}

/// A ball on a belt that is a mesh, with two slopes that meet under it: one manifold, with two normals.
Scene valley(double friction, double speed) {
  nlohmann::json document = document_of("conveyors");
  document["shapes"] = {
      {{"name", "ball"}, {"type", "sphere"}, {"radius", 0.3}},
      {{"name", "belt"},
       {"type", "mesh"},
       {"vertices", {{-20, 4, -20}, {0, 0, -20}, {20, 4, -20}, {-20, 4, 20}, {0, 0, 20}, {20, 4, 20}}},
       {"triangles", {{0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}}}}};
  document["bodies"][0]["position"] = {0, 0.31, 0};
  document["bodies"][1]["position"] = {0, 0, 0};
  document["bodies"][1]["surface_velocity"] = {speed, 0, 0};
  document.erase("expect");
  Scene scene = scene_of(document);
  for (scenes::Body& body : scene.bodies) body.traits.material.friction = friction;
  return scene;
}

TEST(Conveyor, PushesAlongNoneOfSeveralNormals) {
  for (const double speed : {1.0, 100.0}) {
    Simulation simulation(valley(1e-6, speed), "boxstream");
    ASSERT_TRUE(effects::is_on(simulation.plan(), effects::conveyors));
    for (int step = 0; step < 120; ++step) {
      simulation.advance();
      ASSERT_NEAR(place(simulation).x(), 0, 0.002) << speed << " m/s, step " << step;
      ASSERT_NEAR(place(simulation).y(), 0.306, 0.01) << speed << " m/s, step " << step;
    }
    EXPECT_GT(simulation.solver_rows().carried, 200u) << "both slopes";
  }
}

TEST(Conveyor, BuiltWhereItCarriesNothingLetsBodiesSleep) {
  Scene scene = belt();
  scene.bodies[0].traits.material.friction = 0;
  scene.time.steps = 600;
  Simulation simulation(scene, "boxstream", {}, effects::Extent::all);
  run(simulation, 5);
  EXPECT_EQ(simulation.objects()[0]->getActivationState(), ISLAND_SLEEPING);
}

TEST(Conveyor, BuiltWithoutFrictionChangesNothing) {
  const Scene scene = valley(0, 100);
  Simulation plain(scene, "boxstream");
  effects::Plan plan = plain.plan();
  for (effects::Decision& decision : plan)
    if (decision.effect == &effects::conveyors) decision.on = true;
  Simulation with(scene, "boxstream", {}, plan);
  run(plain, 2);
  run(with, 2);
  EXPECT_EQ(place(plain), place(with));
}

TEST(Conveyor, EndFacesPushNothing) {
  Scene scene = belt();
  scene.world.gravity = {0, 0, 0};
  scene.bodies[0].position = {10.5, -1, 0};  // at the face that the surface runs into
  scene.bodies[0].velocity = {-0.01, 0, 0};
  Simulation simulation(scene, "boxstream");
  run(simulation, 2);
  EXPECT_GT(simulation.solver_rows().carried, 0u);
  EXPECT_NEAR(place(simulation).x(), 10.5, 0.06);
}

TEST(Conveyor, KeepsAwakeWhatLiesOnIt) {
  Scene scene = belt();
  scene.bodies[1].surface_velocity = {0.01, 0, 0};  // slower than what Bullet puts to sleep
  scene.time.steps = 600;
  Simulation simulation(scene, "boxstream");
  run(simulation, 10);
  EXPECT_NEAR(place(simulation).x(), 0.1, 0.01);
}

TEST(Conveyor, LeavesOtherContactsAsTheyAre) {
  const auto run_beside = [](bool with_belt) {
    Scene scene = exhibit("friction");
    if (with_belt) {
      const Scene other = belt();
      scene.shapes.insert(scene.shapes.end(), other.shapes.begin(), other.shapes.end());
      for (scenes::Body body : other.bodies) {
        body.traits.shape += 2;
        body.position[0] += 1000;
        scene.bodies.push_back(body);
      }
    }
    Simulation simulation(scene, "boxstream");
    run(simulation, 1);
    return place(simulation);
  };
  EXPECT_EQ(run_beside(true), run_beside(false));
}

}  // namespace
}  // namespace boxstream::effects_test
