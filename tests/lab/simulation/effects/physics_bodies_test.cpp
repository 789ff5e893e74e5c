// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <btBulletDynamicsCommon.h>

#include "formats/scene_model/names.hpp"
#include "gallery.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::effects_test {
namespace {

using scenes::Scene;
using scenes::Simulation;

constexpr double pi = std::numbers::pi;

/// A ball of 1 kg at the origin of empty space, held by one joint to the world.
Scene held(scenes::JointValue joint, scenes::Vec3 gravity = {0, 0, 0}) {
  Scene scene = exhibit("nothing");
  scene.time.dt = 1.0 / 240;
  scene.world.gravity = gravity;
  scene.bodies[0].position = {0, 0, 0};
  scene.bodies[0].velocity = {0, 0, 0};
  scene.joints.push_back({0, std::nullopt, std::move(joint), false});
  return scene;
}

const btRigidBody& body(const Simulation& simulation, std::size_t index = 0) {
  return *btRigidBody::upcast(simulation.objects()[index]);
}

btVector3 place(const Simulation& simulation, std::size_t index = 0) {
  return body(simulation, index).getWorldTransform().getOrigin();
}

void run(Simulation& simulation, double seconds) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / simulation.scene().time.dt)); ++i) simulation.advance();
}

/// A ball of 0.25 m over a floor of 0.2 m, let go at a height.
Scene drop(double height, bool may_sweep) {
  Scene scene = exhibit("contacts");
  scene.world.ccd = may_sweep;
  std::get<scenes::SphereShape>(scene.shapes[0].value).radius = 0.25;
  std::get<scenes::BoxShape>(scene.shapes[1].value).half_extents = {5, 0.1, 5};
  scene.bodies[0].position = {0, height, 0};
  scene.bodies[0].velocity = {0, 0, 0};
  scene.bodies[1].position = {0, -0.1, 0};
  return scene;
}

TEST(CcdOnDemand, KeepsWhatFallsFromAnyHeightAboveAThinFloor) {
  int fell = 0;
  for (int i = 0; i < 60; ++i) {
    const double height = 1 + 9.37 * i;
    const auto end_of = [&](bool may_sweep) {
      Simulation simulation(drop(height, may_sweep), "boxstream");
      run(simulation, std::sqrt(2 * height / 9.81) + 1);
      EXPECT_EQ(simulation.switched_on().size(), may_sweep && height > 23 ? 1u : 0u) << height;
      return place(simulation).y();
    };
    EXPECT_GT(end_of(true), 0) << height;
    fell += end_of(false) < 0 ? 1 : 0;
  }
  EXPECT_GT(fell, 10) << "without sweeping some go through";
}

TEST(CcdOnDemand, SaysWhenAndWhy) {
  Simulation simulation(drop(40, true), "boxstream");
  run(simulation, 3);
  ASSERT_EQ(simulation.switched_on().size(), 1u);
  const effects::SwitchedOn& first = simulation.switched_on()[0];
  EXPECT_EQ(first.effect->name, std::string("ccd"));
  // Half of the ball and half of the floor, at 21 m/s, after 2.15 s.
  EXPECT_EQ(first.step, 129u);
  EXPECT_EQ(first.reason, "body 0 moves 0.352 m in a step, 0.35 m are safe");
}

TEST(CcdOnDemand, LeavesAloneWhatFallsBesideEverything) {
  Scene scene = drop(3, true);
  scene.bodies[0].position = {40, 3, 0};
  Simulation simulation(scene, "boxstream");
  run(simulation, 10);
  EXPECT_LT(place(simulation).y(), -400);
  EXPECT_TRUE(simulation.switched_on().empty());
}

/// Largest change of a plank's angular momentum, as a share of it, in ten seconds after a ball hit it off its centre.
double drift(bool gyro) {
  nlohmann::json document = document_of("contacts");
  document["world"]["gravity"] = {0, 0, 0};
  document["shapes"][1]["half_extents"] = {1, 0.05, 0.3};
  document["bodies"][0]["position"] = {0.8, 2, 0.2};
  document["bodies"][0]["velocity"] = {0, -1, 0};
  document["bodies"][1] = {{"name", "plank"}, {"shape", "ground"}, {"material", "smooth"}, {"mass", 1}};
  if (!gyro) document["bodies"][1]["gyro"] = false;
  document.erase("expect");
  Simulation simulation(scene_of(document), "boxstream");
  const auto momentum = [&] {
    const btRigidBody& plank = body(simulation, 1);
    return plank.getInvInertiaTensorWorld().inverse() * plank.getAngularVelocity();
  };
  run(simulation, 2.5);
  const btVector3 after_hit = momentum();
  EXPECT_GT(after_hit.length(), 0.1);
  double most = 0;
  for (int i = 0; i < 600; ++i) {
    simulation.advance();
    most = std::max(most, double{(momentum() - after_hit).length() / after_hit.length()});
  }
  return most;
}

TEST(Gyroscopic, KeepsTheAngularMomentumOfAPlankThatIsHit) {
  EXPECT_LT(drift(true), 0.1);
  EXPECT_GT(drift(false), 1) << "it turns round with the plank";
}

TEST(Joints, ABallOnAnArmSwingsAsAPendulumDoes) {
  // Let go 0.1 rad from straight down, on an arm of 2 m.
  const double length = 2, angle = 0.1;
  Scene scene = held(scenes::BallJoint{{-length * std::sin(angle), length * std::cos(angle), 0}}, {0, -9.81, 0});
  Simulation simulation(scene, "boxstream");
  // A body that hangs on its pivot turns with it: its own inertia counts. Large angles take 1 + angle^2 / 16 longer.
  const double period = 2 * pi * std::sqrt((length + 0.4 * 0.25 / length) / 9.81) * (1 + angle * angle / 16);
  run(simulation, period / 2);
  EXPECT_NEAR(place(simulation).x(), -2 * length * std::sin(angle), 0.01);
  run(simulation, period / 2);
  EXPECT_NEAR(place(simulation).x(), 0, 0.01);
}

TEST(Joints, ASliderLetsABodyFallAlongItsAxisAlone) {
  const double root = std::sqrt(0.5);
  Simulation simulation(held(scenes::SliderJoint{{0, 0, 0}, {root, -root, 0}}, {0, -10, 0}), "boxstream");
  run(simulation, 1);
  // Down a slope of 45 degrees: g sin(45) along it.
  EXPECT_NEAR(place(simulation).x(), 2.5, 0.03);
  EXPECT_NEAR(place(simulation).y(), -2.5, 0.03);
  EXPECT_NEAR(place(simulation).z(), 0, 1e-3);
}

TEST(Joints, ASliderEndsAtItsLimits) {
  scenes::SliderJoint slider{{0, 0, 0}, {0, 1, 0}, {}, {}};
  slider.limits = {{-0.5, 0.25}};
  for (const double gravity : {-5.0, 5.0}) {
    Simulation simulation(held(slider, {0, gravity, 0}), "boxstream");
    run(simulation, 5);
    EXPECT_NEAR(place(simulation).y(), gravity < 0 ? -0.5 : 0.25, 0.02);
  }
}

TEST(Motors, OfASliderKeepASpeedAndStallBeyondTheirForce) {
  scenes::SliderJoint slider{{0, 0, 0}, {0, 1, 0}, {}, {}};
  slider.motor = scenes::Motor{0.5, 20};
  Simulation lifts(held(slider, {0, -10, 0}), "boxstream");
  run(lifts, 1);
  const double before = place(lifts).y();
  run(lifts, 1);
  EXPECT_NEAR(place(lifts).y() - before, 0.5, 0.01);
  slider.motor->max_force = 4;
  Simulation weak(held(slider, {0, -10, 0}), "boxstream");
  run(weak, 1);
  EXPECT_NEAR(body(weak).getLinearVelocity().y(), -6, 0.1) << "10 N down, 4 N up";
}

TEST(Motors, OfAHingeKeepASpeedAndItsSign) {
  scenes::HingeJoint hinge{{0, 0, 0}, {0, 1, 0}, {}, {}};
  for (const double speed : {2.0, -3.0}) {
    hinge.motor = scenes::Motor{speed, 50};
    Simulation simulation(held(hinge), "boxstream");
    run(simulation, 2);
    EXPECT_NEAR(body(simulation).getAngularVelocity().y(), speed, 0.02);
  }
}

/// At less than 0.8 m/s and 1 rad/s, for longer than the 2 s after which Bullet puts that to rest.
TEST(Sleeping, LetsSpringsAndMotorsGoOn) {
  Scene turned = held(scenes::HingeJoint{{0, 0, 0}, {0, 0, 1}, {}, scenes::Motor{0.4, 50}});
  turned.bodies[0].traits.sleep = true;
  turned.time.steps = 1200;
  Simulation turning(turned, "boxstream");
  run(turning, 5);
  EXPECT_NEAR(body(turning).getAngularVelocity().z(), 0.4, 1e-3);
  EXPECT_NEAR(2 * std::acos(std::abs(double{body(turning).getWorldTransform().getRotation().w()})), 5 * 0.4, 0.01);

  // It passes its middle every half period of pi s, slowest where it is drawn out by 0.15 m.
  Scene drawn = held(scenes::SpringJoint{{0, 0, 0}, 4, 0});
  drawn.bodies[0].traits.sleep = true;
  drawn.bodies[0].velocity = {0.3, 0, 0};
  drawn.time.steps = 1200;
  Simulation drawing(drawn, "boxstream");
  run(drawing, 5);
  EXPECT_TRUE(body(drawing).isActive());
  EXPECT_NEAR(double{place(drawing).x()}, 0.3 / 2 * std::sin(2 * 5.0), 2e-3);
}

TEST(Joints, AHingeEndsAtItsLimit) {
  // The arm falls from level; the hinge ends 30 degrees further down.
  scenes::HingeJoint hinge{{-2, 0, 0}, {0, 0, 1}, {}, {}};
  hinge.limits = {{-pi / 6, pi / 6}};
  Simulation simulation(held(hinge, {0, -9.81, 0}), "boxstream");
  run(simulation, 5);
  EXPECT_NEAR(place(simulation).x(), -2 + 2 * std::cos(pi / 6), 0.03);
  EXPECT_NEAR(place(simulation).y(), -2 * std::sin(pi / 6), 0.03);
}

TEST(Joints, AConeEndsAtItsSwing) {
  scenes::ConeTwistJoint cone{{-1, 0, 0}, {1, 0, 0}, pi / 6, pi / 6, 0.1};
  Simulation simulation(held(cone, {0, -9.81, 0}), "boxstream");
  run(simulation, 5);
  EXPECT_NEAR(place(simulation).y(), -std::sin(pi / 6), 0.06);
}

TEST(Joints, AFixedOneHoldsPlaceAndRotation) {
  Scene scene = held(scenes::FixedJoint{{0, 1, 0}}, {0, -9.81, 0});
  scene.bodies[0].spin = {3, 2, 1};
  Simulation simulation(scene, "boxstream");
  run(simulation, 3);
  EXPECT_NEAR(place(simulation).length(), 0, 0.01);
  EXPECT_NEAR(body(simulation).getWorldTransform().getRotation().getAngle(), 0, 0.05);
}

TEST(Joints, SixDegreesOfFreedomAreLockedLimitedAndFreeAsTheyAreToldTo) {
  scenes::SixDofJoint joint{{0, 0, 0}, {}, {}};
  joint.linear = {{{1, -1}, {-0.5, 0.5}, {0, 0}}};
  joint.angular = {{{0, 0}, {1, -1}, {-0.25, 0.25}}};
  Scene scene = held(joint, {2, -5, -5});
  scene.bodies[0].spin = {3, 3, 3};
  Simulation simulation(scene, "boxstream");
  run(simulation, 2);
  EXPECT_NEAR(place(simulation).x(), 4, 0.1) << "free: 2/2 * 2^2";
  EXPECT_NEAR(place(simulation).y(), -0.5, 0.02) << "at its limit";
  EXPECT_NEAR(place(simulation).z(), 0, 0.02) << "locked";
  EXPECT_NEAR(body(simulation).getAngularVelocity().y(), 3, 0.3) << "free to spin";
}

TEST(Joints, ASpringSwingsWithItsPeriodAndComesToRestWhereTheWeightIsHeld) {
  scenes::SpringJoint spring{{0, 0, 0}, 40, 0};
  Simulation free(held(spring, {0, -9.81, 0}), "boxstream");
  const double period = 2 * pi * std::sqrt(1 / 40.0);
  double lowest = 0, when = 0;
  for (int i = 1; i <= 240; ++i) {
    free.advance();
    if (place(free).y() < lowest) {
      lowest = place(free).y();
      when = i / 240.0;
    }
    if (i > 240 * period) break;
  }
  EXPECT_NEAR(when, period / 2, 0.03);
  EXPECT_NEAR(lowest, -2 * 9.81 / 40, 0.03);
  spring.damping = 4;
  Simulation damped(held(spring, {0, -9.81, 0}), "boxstream");
  run(damped, 10);
  EXPECT_NEAR(place(damped).y(), -9.81 / 40, 0.01);
}

TEST(Vehicles, DriveAheadAndRoundTheBend) {
  Scene scene = exhibit("vehicles");
  std::get<scenes::BoxShape>(scene.shapes[1].value).half_extents = {500, 1, 500};
  Simulation straight(scene, "boxstream");
  const btVector3 start = place(straight, 2);
  for (int i = 0; i < 300; ++i) straight.advance();
  EXPECT_GT(place(straight, 2).z(), start.z() + 5);
  EXPECT_NEAR(place(straight, 2).x(), start.x(), 0.5);
  EXPECT_NEAR(place(straight, 2).y(), start.y(), 0.5) << "on its wheels";
  scene.vehicles[0].steer = 0.2;
  Simulation bend(scene, "boxstream");
  for (int i = 0; i < 300; ++i) bend.advance();
  EXPECT_GT(place(bend, 2).x(), start.x() + 0.5) << "+x is to the left of +z when y is up";
}

TEST(Vehicles, DriveAheadHoweverTheyAreTurned) {
  Scene scene = exhibit("vehicles");
  std::get<scenes::BoxShape>(scene.shapes[1].value).half_extents = {500, 1, 500};
  for (const double yaw : {-2.0, 0.7, 3.0}) {
    scene.bodies[2].rotation = {0, std::sin(yaw / 2), 0, std::cos(yaw / 2)};
    Simulation simulation(scene, "boxstream");
    const btVector3 start = place(simulation, 2);
    for (int i = 0; i < 300; ++i) simulation.advance();
    const btVector3 way = place(simulation, 2) - start;
    const double ahead = double{way.x()} * std::sin(yaw) + double{way.z()} * std::cos(yaw);
    EXPECT_GT(ahead, 5) << yaw;
    EXPECT_NEAR(double{way.x()} * std::cos(yaw) - double{way.z()} * std::sin(yaw), 0, 0.5) << yaw;
    EXPECT_NEAR(way.y(), 0, 0.5) << yaw;
  }
}

TEST(Restitution, GivesBackTheProductOfTheTwoCoefficients) {
  Scene scene = exhibit("restitution");
  scene.solver.split_impulse = true;  // taking deep contacts apart gives no speed
  for (const double height : {2.0, 3.0, 4.1}) {
    scene.bodies[0].position[1] = height;
    Simulation simulation(scene, "boxstream");
    double before = 0, after = 0;
    for (int i = 0; i < 100 && after <= 0; ++i) {
      before = after;
      simulation.advance();
      after = double{body(simulation).getLinearVelocity().y()};
    }
    // Bullet mends a fifth of what is up to 4 cm deep in a step, with speed, and takes a contact that is found up to
    // 2 cm above the floor for one that closes within the step.
    EXPECT_LE(after, -0.64 * before + 0.2 * 0.04 * 60) << height;
    EXPECT_GE(after, -0.64 * before - 0.02 * 60) << height;
  }
}

TEST(Friction, SlowsASlidingBoxDownByItsCoefficient) {
  Scene scene = exhibit("friction");
  scene.shapes[0].value = scenes::BoxShape{{0.5, 0.5, 0.5}};
  scene.bodies[0].velocity = {3, 0, 0};
  Simulation simulation(scene, "boxstream");
  for (int i = 0; i < 30; ++i) simulation.advance();
  EXPECT_NEAR(body(simulation).getLinearVelocity().x(), 3 - 0.25 * 9.81 * 0.5, 0.05) << "0.5 of each, multiplied";
}

TEST(SpinningFriction, SlowsABallDownThatSpinsOnTheSpotAndRollsNoneDown) {
  Scene scene = exhibit("spinning_friction");
  const auto left = [&](double spinning) {
    for (scenes::Body& b : scene.bodies) b.traits.material.spinning = spinning;
    Simulation simulation(scene, "boxstream");
    for (int i = 0; i < 60; ++i) simulation.advance();
    return double{body(simulation).getAngularVelocity().y()};
  };
  EXPECT_NEAR(left(0), 10, 0.1);
  EXPECT_LT(left(0.1), 9);
}

/// A car at rest on its wheels, whose springs are deflected by g / (wheels * stiffness).
Scene car(double mass, double stiffness) {
  Scene scene = exhibit("vehicles");
  scenes::Vehicle& vehicle = scene.vehicles[0];
  vehicle.engine = 0;
  vehicle.stiffness = stiffness;
  scenes::Body& chassis = scene.bodies[vehicle.chassis];
  chassis.traits.mass = mass;
  const scenes::Wheel& wheel = vehicle.wheels[0];
  chassis.position[1] = wheel.radius + vehicle.suspension - wheel.at[1] - 9.81 / (4 * stiffness);
  return scene;
}

TEST(Vehicles, SinkByTheirStiffnessWhateverTheyWeigh) {
  for (const double mass : {600.0, 9000.0, 60'000.0}) {
    Scene scene = car(mass, 30);
    const double height = scene.bodies[scene.vehicles[0].chassis].position[1];
    Simulation simulation(scene, "boxstream");
    run(simulation, 2);
    EXPECT_NEAR(place(simulation, scene.vehicles[0].chassis).y(), height, 1e-3) << mass << " kg";
  }
}

TEST(Vehicles, BrakeAlikeInAnyNumberOfSubsteps) {
  for (const int substeps : {1, 5}) {
    Scene scene = car(1200, 20);
    scene.time.substeps = substeps;
    scenes::Vehicle& vehicle = scene.vehicles[0];
    vehicle.brake = 10;
    scene.bodies[vehicle.chassis].velocity = {0, 0, 3};
    Simulation simulation(scene, "boxstream");
    for (int i = 0; i < 30; ++i) simulation.advance();
    // Four wheels take 10 N s each in a step.
    EXPECT_NEAR(body(simulation, vehicle.chassis).getLinearVelocity().z(), 3 - 30 * 4 * 10 / 1200.0, 1e-3) << substeps;
  }
}

/// Drops leave before their turn comes again, and are too far apart to meet: what moves depends on no order of pairs.
Scene rain(scenes::OnLeave on_leave) {
  Scene scene = exhibit("respawn");
  scene.world.on_leave = on_leave;
  auto& respawn = std::get<scenes::RespawnGenerator>(scene.generators[0]);
  respawn.size = {400, 1, 400};
  respawn.velocity = {0, -6, 0};
  respawn.every = 20;
  scene.world.bounds = {{-300, 3, -300}, {300, 50, 300}};
  return scene;
}

TEST(RainAndLeaving, AreTheSameOnEveryBroadphase) {
  const Scene scene = rain(scenes::OnLeave::remove);
  std::vector<std::uint64_t> expected;
  for (const std::string& name : scenes::broadphase_names()) {
    Simulation simulation(scene, name);
    std::vector<std::uint64_t> found;
    for (int i = 0; i < 120; ++i) {
      simulation.step();
      found.push_back(simulation.state_hash());
    }
    EXPECT_GT(simulation.left(), 5u);
    EXPECT_TRUE(simulation.is_finite());
    found.push_back(simulation.left());
    if (expected.empty()) expected = found;
    EXPECT_EQ(found, expected) << name;
  }
}

TEST(RainAndLeaving, WhatWasFrozenFallsAgain) {
  Simulation simulation(rain(scenes::OnLeave::freeze), "boxstream");
  const std::size_t bodies = simulation.objects().size();
  for (int i = 0; i < 2000 && simulation.left() <= 2 * bodies; ++i) simulation.step();
  EXPECT_GT(simulation.left(), 2 * bodies) << "each leaves once and is never seen again";
}

/// One ball freezes just below the bounds, and another of its radius of 0.4 m lands on it.
TEST(OutOfBounds, WhatIsFrozenBearsWhatFallsOnIt) {
  for (const auto extent : {effects::Extent::only_called, effects::Extent::all}) {
    Scene scene = exhibit("out_of_bounds");
    scene.time.dt = 1.0 / 240;
    scene.world.gravity = {0, -9.81, 0};
    scene.world.bounds = {{-10, 0, -10}, {10, 20, 10}};
    scene.world.on_leave = scenes::OnLeave::freeze;
    std::get<scenes::SphereShape>(scene.shapes[0].value).radius = 0.4;
    scene.bodies[0].traits.mass = 2;
    scene.bodies[0].velocity = {0, 0, 0};
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[0].position = {0, 0.7, 0};
    scene.bodies[1].position = {0, 3, 0};
    Simulation simulation(scene, "boxstream", {}, extent);
    while (simulation.left() == 0) simulation.advance();
    const btVector3 frozen = place(simulation);
    run(simulation, 2);
    EXPECT_EQ(place(simulation), frozen);
    EXPECT_EQ(body(simulation).getLinearVelocity(), btVector3(0, 0, 0));
    EXPECT_NEAR(place(simulation, 1).y(), frozen.y() + 0.8, 0.002);
    EXPECT_EQ(simulation.outside(), 1u) << "it is out of bounds still";
  }
}

}  // namespace
}  // namespace boxstream::effects_test
