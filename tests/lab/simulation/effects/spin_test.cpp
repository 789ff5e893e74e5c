// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include "formats/geometry/frame.hpp"
#include "gallery.hpp"
#include "simulation/engine/free_rotation.hpp"
#include "simulation/run/simulation.hpp"

// Bodies that turn with no torque on them, and with some, against closed forms.
namespace boxstream::effects_test {
namespace {

using geometry::dot;
using scenes::FreeRotation;
using scenes::Quat;
using scenes::Scene;
using scenes::Simulation;
using scenes::Vec3;

constexpr double pi = std::numbers::pi;

double length(const Vec3& a) {
  return std::sqrt(dot(a, a));
}

double distance(const Vec3& a, const Vec3& b) {
  return length(geometry::minus(a, b));
}

double energy(const Vec3& moments, const Vec3& spin) {
  return 0.5 * (moments[0] * spin[0] * spin[0] + moments[1] * spin[1] * spin[1] + moments[2] * spin[2] * spin[2]);
}

/// Time between two moments at which a body does not turn about its middle axis, the second one: half a period of
/// Jacobi's sine, 2 K(k) / rate, of moments that grow.
double time_between_flips(const Vec3& moments, const Vec3& spin) {
  const auto& [a, b, c] = moments;
  const double twice = 2 * energy(moments, spin);
  const double square = a * a * spin[0] * spin[0] + b * b * spin[1] * spin[1] + c * c * spin[2] * spin[2];
  double high = (c - b) * (square - twice * a), low = (b - a) * (twice * c - square);
  if (low > high) std::swap(low, high);
  // K by the mean of Gauss.
  double x = 1, y = std::sqrt(1 - low / high);
  for (int i = 0; i < 60; ++i) {
    const double mean = (x + y) / 2;
    y = std::sqrt(x * y);
    x = mean;
  }
  return 2 * pi / (2 * x) / std::sqrt(high / (a * b * c));
}

const Vec3 racket{0.013, 0.061, 0.07};
const Vec3 racket_spin{0.03, 9, 0.02};

TEST(FreeRotation, KeepsEnergyAndMomentumForAnHour) {
  const FreeRotation body(racket);
  FreeRotation::State state{racket_spin, {0, 0, 0, 1}};
  const Vec3 before = body.momentum(state);
  for (int i = 0; i < 60 * 3600; ++i) ASSERT_TRUE(body.advance(1.0 / 60, state));
  EXPECT_NEAR(energy(racket, state.spin) / energy(racket, racket_spin), 1, 1e-9);
  EXPECT_LT(distance(body.momentum(state), before) / length(before), 1e-9);
}

/// Of a body with two equal moments the closed form is two turns: about its momentum, and about its own axis.
TEST(FreeRotation, OfASymmetricTopIsTwoTurns) {
  const Vec3 moments{0.3, 0.3, 0.5}, spin{2, 0, 7};
  const FreeRotation body(moments);
  FreeRotation::State state{spin, {0, 0, 0, 1}};
  const Vec3 momentum = body.momentum(state);
  for (int i = 0; i < 600; ++i) body.advance(1.0 / 60, state);
  const double own = 7 * (1 - 0.5 / 0.3) * 10;
  // About its own axis the spin turns backwards, by the difference of the moments.
  EXPECT_NEAR(state.spin[0], 2 * std::cos(own), 1e-4);
  EXPECT_NEAR(state.spin[1], -2 * std::sin(own), 1e-4);
  const double about = length(momentum) / 0.3 * 10;
  const Vec3 axis = geometry::turned(state.rotation, Vec3{0, 0, 1});
  // z, turned by the angle `about` around the momentum (Rodrigues).
  const Vec3 m{momentum[0] / length(momentum), 0, momentum[2] / length(momentum)};
  const double c = std::cos(about), s = std::sin(about);
  EXPECT_NEAR(axis[0], m[2] * m[0] * (1 - c), 1e-4);
  EXPECT_NEAR(axis[1], -m[0] * s, 1e-4);
  EXPECT_NEAR(axis[2], c + m[2] * m[2] * (1 - c), 1e-4);
}

/// Angle between where a body is after two seconds and where it is with steps of a thousandth.
double error_of(int steps_a_second) {
  const FreeRotation body(racket);
  const auto end = [&](int rate) {
    FreeRotation::State state{{1, 2, -1}, {0, 0, 0, 1}};
    for (int i = 0; i < 2 * rate; ++i) body.advance(1.0 / rate, state);
    return state.rotation;
  };
  const Quat a = end(steps_a_second), b = end(5000);
  const Vec3 x = geometry::turned(a, Vec3{1, 0, 0}), y = geometry::turned(b, Vec3{1, 0, 0});
  return distance(x, y);
}

TEST(FreeRotation, IsOfFourthOrder) {
  const double order = std::log2(error_of(20) / error_of(40));
  EXPECT_NEAR(order, 4, 0.3);
}

TEST(FreeRotation, LeavesWhatIsTooFastOrNotANumber) {
  const FreeRotation body(racket);
  FreeRotation::State fast{{1e9, 0, 0}, {0, 0, 0, 1}}, wrong{{std::nan(""), 0, 0}, {0, 0, 0, 1}};
  EXPECT_FALSE(body.advance(1.0 / 60, fast));
  EXPECT_FALSE(body.advance(1.0 / 60, wrong));
  EXPECT_EQ(fast.spin[0], 1e9);
}

Scene handle(const Vec3& moments, const Vec3& spin) {
  Scene scene = exhibit("gyroscopic");
  scene.bodies[0].inertia = moments;
  scene.bodies[0].spin = spin;
  scene.bodies[0].velocity = {0, 0, 0};
  scene.bodies[0].traits.sleep = false;
  return scene;
}

const btRigidBody& body(const Simulation& simulation) {
  return *btRigidBody::upcast(simulation.objects()[0]);
}

Vec3 spin_of(const Simulation& simulation) {
  const btVector3 spin = body(simulation).getAngularVelocity() * body(simulation).getWorldTransform().getBasis();
  return {spin.x(), spin.y(), spin.z()};
}

/// In the world.
Vec3 momentum_of(const Simulation& simulation, const Vec3& moments) {
  const Vec3 spin = spin_of(simulation);
  const btVector3 own(btScalar(spin[0] * moments[0]), btScalar(spin[1] * moments[1]), btScalar(spin[2] * moments[2]));
  const btVector3 momentum = body(simulation).getWorldTransform().getBasis() * own;
  return {momentum.x(), momentum.y(), momentum.z()};
}

TEST(Spin, OfARacketKeepsEnergyMomentumAndTheTimesOfItsFlipsForAMinute) {
  Simulation simulation(handle(racket, racket_spin), "boxstream");
  const Vec3 momentum = momentum_of(simulation, racket);
  double energy_drift = 0, momentum_drift = 0;
  std::vector<double> flips;
  double before = racket_spin[1];
  for (int step = 1; step <= 3600; ++step) {
    simulation.advance();
    const Vec3 spin = spin_of(simulation);
    energy_drift = std::max(energy_drift, std::abs(energy(racket, spin) / energy(racket, racket_spin) - 1));
    momentum_drift = std::max(momentum_drift, distance(momentum_of(simulation, racket), momentum) / length(momentum));
    if (before * spin[1] < 0) flips.push_back((step - 1 + before / (before - spin[1])) / 60);
    before = spin[1];
  }
  EXPECT_LT(energy_drift, 1e-5);
  EXPECT_LT(momentum_drift, 1e-5);
  const double apart = time_between_flips(racket, racket_spin);
  ASSERT_GT(flips.size(), 10u);
  EXPECT_EQ(flips.size(), static_cast<std::size_t>((60 - flips[0]) / apart) + 1);
  for (std::size_t i = 1; i < flips.size(); ++i)
    EXPECT_NEAR(flips[i], flips[0] + static_cast<double>(i) * apart, 0.003) << i;
}

TEST(Spin, ThatIsDampedKeepsTheDirectionOfItsMomentum) {
  Scene scene = handle(racket, {2, 5, 3});
  scene.bodies[0].traits.angular_damping = 0.05;
  Simulation simulation(scene, "boxstream");
  const Vec3 before = momentum_of(simulation, racket);
  for (int step = 0; step < 1200; ++step) simulation.advance();
  const Vec3 after = momentum_of(simulation, racket);
  EXPECT_LT(distance(scenes::times(after, std::pow(0.95, -20)), before) / length(before), 1e-3);
}

/// A torque along the momentum makes it longer and does not turn it.
TEST(Spin, TakesATorqueAsAChangeOfItsMomentum) {
  Simulation simulation(handle(racket, {2, 5, 3}), "boxstream");
  const Vec3 before = momentum_of(simulation, racket);
  const btVector3 torque(btScalar(before[0] / 4), btScalar(before[1] / 4), btScalar(before[2] / 4));
  for (int step = 0; step < 480; ++step) {
    const_cast<btRigidBody&>(body(simulation)).applyTorque(torque);
    simulation.advance();
  }
  EXPECT_LT(distance(momentum_of(simulation, racket), scenes::times(before, 3)) / length(before), 1e-3);
}

TEST(Spin, FasterThanAnEighthOfATurnAStepIsFollowed) {
  const Vec3 round{0.5, 0.5, 0.3};
  Simulation simulation(handle(round, {0, 0, 90}), "boxstream");
  for (int step = 0; step < 7; ++step) simulation.advance();
  const btVector3 x = body(simulation).getWorldTransform().getBasis().getColumn(0);
  EXPECT_NEAR(x.x(), std::cos(90 * 7.0 / 60), 1e-4);
  EXPECT_NEAR(x.y(), std::sin(90 * 7.0 / 60), 1e-4);
}

/// A top on a ball joint at its tip, its axis level, precesses by weight times arm over its spin's momentum. It starts
/// with that motion, so that it does not nod.
TEST(Spin, OfATopOnItsTipPrecesses) {
  const double arm = 0.4, wheel = 0.2, cross = 0.15, turns = 60;
  Scene scene = handle({cross, cross, wheel}, {0, 0, turns});
  scene.time.dt = 1.0 / 240;
  scene.world.gravity = {0, -9.81, 0};
  // About y, through the tip at the origin; the wheel is at +z.
  const double rate = 9.81 * arm / (wheel * turns);
  scene.bodies[0].traits.mass = 1;
  scene.bodies[0].position = {0, 0, arm};
  scene.bodies[0].spin = {0, rate, turns};
  scene.bodies[0].velocity = {rate * arm, 0, 0};
  scene.joints.push_back({0, std::nullopt, scenes::BallJoint{{0, 0, 0}}, false});
  Simulation simulation(scene, "boxstream");
  const double seconds = 4;
  for (int step = 0; step < 240 * seconds; ++step) simulation.advance();
  const btVector3 place = body(simulation).getWorldTransform().getOrigin();
  EXPECT_NEAR(std::atan2(place.x(), place.z()), rate * seconds, 0.03 * rate * seconds);
  EXPECT_NEAR(place.y(), 0, 0.02 * arm);
  EXPECT_NEAR(spin_of(simulation)[2], turns, 0.01 * turns);
}

}  // namespace
}  // namespace boxstream::effects_test
