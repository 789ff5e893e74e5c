// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <btBulletDynamicsCommon.h>

#include "gallery.hpp"
#include "simulation/run/simulation.hpp"

// Motion without contact against closed forms: how large errors are, and that they shrink with the step as the method
// says. Bullet's is the symplectic method of Euler: first new velocities, then places with these.
namespace boxstream::effects_test {
namespace {

using scenes::Scene;
using scenes::Simulation;

constexpr double pi = std::numbers::pi;

/// A ball of 2 kg at the origin of empty space.
Scene ball(double dt) {
  Scene scene = exhibit("nothing");
  scene.time.dt = dt;
  scene.bodies[0].position = {0, 0, 0};
  scene.bodies[0].velocity = {0, 0, 0};
  scene.bodies[0].traits.mass = 2;
  scene.bodies[0].traits.sleep = false;
  return scene;
}

const btRigidBody& body(const Simulation& simulation) {
  return *btRigidBody::upcast(simulation.objects()[0]);
}

btVector3 place(const Simulation& simulation) {
  return body(simulation).getWorldTransform().getOrigin();
}

btVector3 velocity(const Simulation& simulation) {
  return body(simulation).getLinearVelocity();
}

void run(Simulation& simulation, double seconds) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / simulation.scene().time.dt)); ++i) simulation.advance();
}

/// By how many powers of the step an error shrinks.
template <class Error>
double order(Error error, double dt) {
  return std::log2(error(dt) / error(dt / 2));
}

TEST(Orders, AProjectileIsLowByHalfAStepsFall) {
  const auto error = [](double dt) {
    Scene scene = ball(dt);
    scene.world.gravity = {0, -9.81, 0};
    scene.bodies[0].velocity = {7, 12, 0};
    Simulation simulation(scene, "boxstream");
    const double t = 2;
    run(simulation, t);
    EXPECT_NEAR(place(simulation).x(), 7 * t, 1e-3);
    EXPECT_NEAR(velocity(simulation).y(), 12 - 9.81 * t, 1e-3);
    // In closed form, of this method: a fall of g t (t + dt) / 2.
    EXPECT_NEAR(place(simulation).y(), 12 * t - 9.81 * t * (t + dt) / 2, 1e-3);
    return std::abs(double{place(simulation).y()} - (12 * t - 9.81 * t * t / 2));
  };
  EXPECT_NEAR(order(error, 1.0 / 30), 1, 0.02);
}

Scene on_spring(double stiffness, double damping, double dt) {
  Scene scene = ball(dt);
  scene.joints.push_back({0, std::nullopt, scenes::SpringJoint{{0, 0, 0}, stiffness, damping}, false});
  return scene;
}

/// Time of two crossings of the middle.
double period(Simulation& simulation) {
  double first = 0, before = place(simulation).x();
  for (int step = 1, crossings = 0; step < 100'000; ++step) {
    simulation.advance();
    const double now = place(simulation).x();
    if ((before < 0) != (now < 0)) {
      const double when = (step - 1 + before / (before - now)) * simulation.scene().time.dt;
      if (++crossings == 1) first = when;
      if (crossings == 11) return (when - first) / 5;
    }
    before = now;
  }
  return 0;
}

TEST(Orders, ASpringsPeriodIsOfSecondOrderAndItsSwingStays) {
  const double stiffness = 50, rate = 5;  // sqrt(50 / 2)
  const auto error = [&](double dt) {
    Scene scene = on_spring(stiffness, 0, dt);
    scene.bodies[0].velocity = {1, 0, 0};
    Simulation simulation(scene, "boxstream");
    return std::abs(period(simulation) * rate / (2 * pi) - 1);
  };
  EXPECT_LT(error(1.0 / 60), 5e-4);
  EXPECT_NEAR(order(error, 1.0 / 25), 2, 0.2);
  Scene scene = on_spring(stiffness, 0, 1.0 / 60);
  scene.bodies[0].velocity = {1, 0, 0};
  Simulation simulation(scene, "boxstream");
  run(simulation, 60);
  double most = 0;
  for (int i = 0; i < 120; ++i) {
    simulation.advance();
    most = std::max(most, std::abs(double{place(simulation).x()}));
  }
  EXPECT_NEAR(most, 1 / rate, 0.06 / rate);
}

TEST(Orders, ADampedSpringDecaysAsItsDampingSays) {
  Scene scene = on_spring(50, 1.2, 1.0 / 240);
  scene.bodies[0].velocity = {1, 0, 0};
  Simulation simulation(scene, "boxstream");
  const double decay = 1.2 / 4, rate = std::sqrt(25 - decay * decay);
  for (int i = 1; i <= 5; ++i) {
    run(simulation, 1);
    const double exact = std::exp(-decay * i) / rate * std::sin(rate * i);
    EXPECT_NEAR(place(simulation).x(), exact, 0.004) << i;
  }
}

/// Above its anchor gravity pulls a ball the same way as the spring does, and more strongly.
TEST(Orders, ASpringPullsInAdditionToGravity) {
  Scene scene = on_spring(5, 0, 1.0 / 240);
  scene.world.gravity = {0, -3, 0};
  scene.bodies[0].velocity = {0, 1, 0};
  Simulation simulation(scene, "boxstream");
  const double rate = std::sqrt(5.0 / 2), sag = 3 * 2 / 5.0;
  for (int i = 1; i <= 16; ++i) {
    run(simulation, 0.25);
    const double angle = rate * 0.25 * i;
    EXPECT_NEAR(place(simulation).y(), sag * (std::cos(angle) - 1) + std::sin(angle) / rate, 0.01) << i;
  }
}

/// Period of a pendulum of any swing, by the mean of Gauss.
double pendulum_period(double length, double angle) {
  double a = 1, b = std::cos(angle / 2);
  for (int i = 0; i < 40; ++i) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2 * pi * std::sqrt(length / 9.81) / a;
}

TEST(Orders, APendulumThatSwingsFarTakesItsTime) {
  // Let go 70 degrees from straight down; a ball that turns with its arm is a longer pendulum.
  const double arm = 1.5, angle = 70 * pi / 180, length = arm + 0.4 * 0.25 / arm;
  Scene scene = ball(1.0 / 480);
  scene.world.gravity = {0, -9.81, 0};
  scene.bodies[0].position = {arm * std::sin(angle), -arm * std::cos(angle), 0};
  scene.joints.push_back({0, std::nullopt, scenes::BallJoint{{0, 0, 0}}, false});
  Simulation simulation(scene, "boxstream");
  const double exact = pendulum_period(length, angle);
  EXPECT_NEAR(period(simulation), exact, 0.005 * exact);
}

TEST(Orders, DampingIsAPowerOfTimeWhateverTheStep) {
  for (const double dt : {1.0 / 10, 1.0 / 60, 1.0 / 240}) {
    Scene scene = ball(dt);
    scene.bodies[0].velocity = {6, 0, 0};
    scene.bodies[0].traits.linear_damping = 0.3;
    Simulation simulation(scene, "boxstream");
    run(simulation, 3);
    EXPECT_NEAR(velocity(simulation).x(), 6 * std::pow(0.7, 3), 1e-4) << dt;
  }
}

TEST(Orders, FallingWithDragIsOfFirstOrderAndEndsAtTerminalSpeed) {
  // v = T tanh(g t / T), of T^2 = m g / k.
  const double quadratic = 0.4, terminal = std::sqrt(2 * 9.81 / quadratic);
  const auto error = [&](double dt) {
    Scene scene = ball(dt);
    scene.world.gravity = {0, -9.81, 0};
    scene.fields.push_back(scenes::DragField{0, quadratic, 0});
    Simulation simulation(scene, "boxstream");
    run(simulation, 0.5);
    const double early = std::abs(double{velocity(simulation).y()} + terminal * std::tanh(9.81 * 0.5 / terminal));
    run(simulation, 20);
    EXPECT_NEAR(velocity(simulation).y(), -terminal, 1e-3);
    return early;
  };
  EXPECT_NEAR(order(error, 1.0 / 40), 1, 0.1);
}

}  // namespace
}  // namespace boxstream::effects_test
