// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <BulletSoftBody/btSoftBody.h>
#include <btBulletDynamicsCommon.h>

#include "gallery.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::effects_test {
namespace {

using scenes::Scene;
using scenes::Simulation;

/// A ball of 1 kg and radius 0.5 in empty space, in small steps.
Scene ball() {
  Scene scene = exhibit("nothing");
  scene.time.dt = 1e-3;
  scene.bodies[0].velocity = {0, 0, 0};
  return scene;
}

const btRigidBody& body(const Simulation& simulation, std::size_t index = 0) {
  return *btRigidBody::upcast(simulation.objects()[index]);
}

/// Of a character, or of the nodes of a soft body.
btVector3 middle(const btCollisionObject& object) {
  const btSoftBody* const soft = btSoftBody::upcast(&object);
  if (soft == nullptr) return object.getWorldTransform().getOrigin();
  btVector3 sum(0, 0, 0);
  for (int i = 0; i < soft->m_nodes.size(); ++i) sum += soft->m_nodes[i].m_x;
  return sum / btScalar(soft->m_nodes.size());
}

void run(Simulation& simulation, double seconds) {
  const double steps = seconds / simulation.scene().time.dt;
  for (int i = 0; i < static_cast<int>(std::lround(steps)); ++i) simulation.advance();
}

TEST(Wind, TakesABallToItsOwnSpeedAsTheDragOfABallDoes) {
  Scene scene = ball();
  const scenes::WindField wind{{10, 0, 0}, 1.2, 0.5};
  scene.fields.push_back(wind);
  Simulation simulation(scene, "boxstream");
  // dv/dt = k (u - v)^2, so u - v = u / (1 + k u t).
  const double k = wind.density / 2 * wind.coefficient * std::numbers::pi * 0.5 * 0.5;
  double seconds = 0;
  for (const double until : {0.5, 2.0, 10.0}) {
    run(simulation, until - seconds);
    seconds = until;
    EXPECT_NEAR(body(simulation).getLinearVelocity().x(), 10 - 10 / (1 + k * 10 * seconds), 0.005) << seconds;
  }
  run(simulation, 60);
  EXPECT_NEAR(body(simulation).getLinearVelocity().x(), 10, 0.1);
}

TEST(Wind, ThatIsAStormTakesAFeatherAlongAndDoesNotThrowItAround) {
  Scene scene = ball();
  scene.time.dt = 1.0 / 60;
  scene.bodies[0].traits.mass = 1e-4;
  scene.fields.push_back(scenes::WindField{{60, 0, 0}});
  Simulation simulation(scene, "boxstream");
  for (int i = 0; i < 60; ++i) {
    simulation.advance();
    EXPECT_NEAR(body(simulation).getLinearVelocity().x(), 60, 0.01);
  }
}

TEST(Drag, LinearIsExponential) {
  Scene scene = ball();
  scene.bodies[0].velocity = {8, 0, 0};
  scene.fields.push_back(scenes::DragField{0.7, 0, 0});
  Simulation simulation(scene, "boxstream");
  run(simulation, 2);
  EXPECT_NEAR(body(simulation).getLinearVelocity().x(), 8 * std::exp(-0.7 * 2), 0.005);
  EXPECT_NEAR(body(simulation).getWorldTransform().getOrigin().x(), 8 / 0.7 * (1 - std::exp(-0.7 * 2)), 0.01);
}

TEST(Drag, QuadraticIsHyperbolic) {
  Scene scene = ball();
  scene.bodies[0].velocity = {0, 0, 8};
  scene.fields.push_back(scenes::DragField{0, 0.3, 0});
  Simulation simulation(scene, "boxstream");
  run(simulation, 3);
  EXPECT_NEAR(body(simulation).getLinearVelocity().z(), 8 / (1 + 0.3 * 8 * 3), 0.005);
}

TEST(Drag, OfSpinIsExponentialAndNeverTurnsItRound) {
  Scene scene = ball();
  scene.bodies[0].spin = {0, 5, 0};
  scene.fields.push_back(scenes::DragField{0, 0, 0.05});
  const double inertia = 0.4 * 0.5 * 0.5;
  Simulation simulation(scene, "boxstream");
  run(simulation, 1);
  EXPECT_NEAR(body(simulation).getAngularVelocity().y(), 5 * std::exp(-0.05 / inertia), 0.005);
  scene.fields = {scenes::DragField{1e4, 1e4, 1e4}};
  scene.bodies[0].velocity = {5, 0, 0};
  Simulation thick(scene, "boxstream");
  for (int i = 0; i < 10; ++i) {
    thick.advance();
    EXPECT_NEAR(body(thick).getAngularVelocity().length(), 0, 1e-3);
    EXPECT_NEAR(body(thick).getLinearVelocity().length(), 0, 1e-3);
  }
}

TEST(Drag, OfSeveralFieldsBringsAFeatherToRestAtOnce) {
  Scene scene = ball();
  scene.time.dt = 1.0 / 120;
  std::get<scenes::SphereShape>(scene.shapes[0].value).radius = 0.15;
  scene.bodies[0].traits.mass = 0.02;
  scene.bodies[0].velocity = {0, 0, 2};
  scene.bodies[0].spin = {3, 0, 0};
  scene.fields = {scenes::BuoyancyField{50, 1000, 300}, scenes::DragField{8, 0, 8}, scenes::DragField{0, 0, 8, 800},
                  scenes::VortexField{{0, 0, 0}, 4, 4, 0, 0, 500}, scenes::WindField{{0, 0, 0}, 900, 0.5}};
  Simulation simulation(scene, "boxstream");
  for (int i = 0; i < 5; ++i) {
    simulation.advance();
    EXPECT_NEAR(body(simulation).getLinearVelocity().length(), 0, 1e-5);
    EXPECT_NEAR(body(simulation).getAngularVelocity().length(), 0, 1e-5);
  }
}

TEST(Buoyancy, LiftsAgainstAnyDrag) {
  Scene scene = ball();
  scene.time.dt = 1.0 / 120;
  scene.world.gravity = {0, -9.81, 0};
  scene.shapes[0].value = scenes::BoxShape{{0.5, 0.4, 0.5}};
  scene.bodies[0].traits.mass.reset();
  scene.bodies[0].traits.density = 600;
  const double afloat = 2 + 0.4 - 0.8 * 0.6;
  scene.bodies[0].position = {0, afloat, 0};
  // Two fluids, which together have a density of 1000, and drag that takes all velocity in a step.
  scene.fields = {scenes::BuoyancyField{2, 300, 1e4}, scenes::BuoyancyField{2, 700, 1e4}, scenes::DragField{1e7, 0, 0}};
  Simulation simulation(scene, "boxstream");
  run(simulation, 3);
  EXPECT_NEAR(body(simulation).getWorldTransform().getOrigin().y(), afloat, 1e-3);
}

TEST(Buoyancy, FloatsABoxAtTheRatioOfDensities) {
  for (const double ratio : {0.25, 0.6, 0.9}) {
    Scene scene = ball();
    scene.time.dt = 1.0 / 120;
    scene.world.gravity = {0, -9.81, 0};
    scene.shapes[0].value = scenes::BoxShape{{0.5, 0.4, 0.5}};
    scene.bodies[0].traits.mass.reset();
    scene.bodies[0].traits.density = 1000 * ratio;
    scene.fields.push_back(scenes::BuoyancyField{2, 1000, 1.5});
    Simulation simulation(scene, "boxstream");
    run(simulation, 80);
    EXPECT_NEAR(body(simulation).getWorldTransform().getOrigin().y(), 2 + 0.4 - 0.8 * ratio, 0.002) << ratio;
    EXPECT_NEAR(body(simulation).getLinearVelocity().length(), 0, 0.002) << ratio;
  }
}

TEST(Buoyancy, LetsAStoneSinkWithItsWeightLessThatOfTheFluid) {
  Scene scene = ball();
  scene.world.gravity = {0, -9.81, 0};
  scene.bodies[0].traits.mass.reset();
  scene.bodies[0].traits.density = 2500;
  scene.fields.push_back(scenes::BuoyancyField{100, 1000, 0});
  Simulation simulation(scene, "boxstream");
  run(simulation, 1);
  EXPECT_NEAR(body(simulation).getLinearVelocity().y(), -9.81 * (1 - 1000.0 / 2500), 0.01);
}

TEST(TumblingGravity, TurnsAndKeepsItsSize) {
  Scene scene = ball();
  scene.time.dt = 1.0 / 60;
  scene.time.substeps = 2;
  scene.world.tumbling = scenes::TumblingGravity{9.81, 116.129};
  Simulation simulation(scene, "boxstream");
  btVector3 sum(0, 0, 0);
  for (int i = 0; i < 20'000; ++i) {
    simulation.advance();
    const btVector3 pull = simulation.world().getGravity();
    ASSERT_NEAR(pull.length(), 9.81, 1e-4) << "step " << i;
    sum += pull;
  }
  EXPECT_LT(sum.length() / 20'000, 0.5 * 9.81);
}

/// What starts at rest has fallen by g t (t + dt) / 2 after whole steps of `dt` seconds.
TEST(TumblingGravity, PullsSoftBodiesAndCharacters) {
  for (const char* const name : {"soft_bodies", "characters"}) {
    Scene scene = exhibit(name);
    scene.time.dt = 1.0 / 240;
    scene.world.tumbling = scenes::TumblingGravity{4, 0};  // it stays along +x
    scene.bodies.clear();
    for (scenes::SoftBody& soft : scene.soft_bodies) {
      std::get<scenes::ClothSoft>(soft.value).pinned = 0;
      soft.damping = 0;
    }
    for (scenes::Character& character : scene.characters) character.speed = 0;
    Simulation simulation(scene, "boxstream");
    const btVector3 start = middle(*simulation.objects()[0]);
    run(simulation, 0.5);
    const btVector3 way = middle(*simulation.objects()[0]) - start;
    EXPECT_NEAR(way.x(), 4 * 0.5 * (0.5 + scene.time.dt) / 2, 0.002) << name;
    EXPECT_NEAR(way.y(), 0, 1e-3) << name;
    EXPECT_NEAR(way.z(), 0, 1e-3) << name;
  }
}

TEST(Swirl, CarriesABallRoundAtTheSpeedOfTheAir) {
  Scene scene = ball();
  scene.bodies[0].position = {2, 1, 0};
  scene.fields.push_back(scenes::VortexField{{0, 0, 0}, 4, 4, 2, 0, 1e6});
  Simulation simulation(scene, "boxstream");
  run(simulation, 1);
  // Half way out, at half the speed; a rate beyond the step's is the speed of the air at once.
  EXPECT_NEAR(body(simulation).getLinearVelocity().length(), 1, 0.01);
  EXPECT_NEAR(body(simulation).getWorldTransform().getOrigin().y(), 1, 1e-3);
}

TEST(Kicks, GiveEachBodyASpeedWithinTheBall) {
  Scene scene = ball();
  scene.fields.push_back(scenes::ImpulsesField{1, 3});
  Simulation simulation(scene, "boxstream");
  double most = 0;
  for (int i = 0; i < 2000; ++i) {
    simulation.advance();
    const double speed = double{body(simulation).getLinearVelocity().length()};
    ASSERT_LE(speed, 3.0001);
    most = std::max(most, speed);
  }
  EXPECT_GT(most, 2.9);
}

TEST(Kicks, AreGivenToTheShareRoundedUp) {
  for (const auto& [share, count] : {std::pair{0.14, 7}, {0.15, 8}, {0.28, 14}, {1e-9, 1}, {1.0, 50}}) {
    Scene scene = ball();
    scene.bodies.resize(50, scene.bodies[0]);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) scene.bodies[i].position[0] = 3 * static_cast<double>(i);
    scene.fields.push_back(scenes::ImpulsesField{share, 3});
    Simulation simulation(scene, "boxstream");
    simulation.advance();
    int moving = 0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) moving += !body(simulation, i).getLinearVelocity().isZero();
    EXPECT_EQ(moving, count) << share;
  }
}

TEST(Kicks, LeaveWhatIsFrozenAlone) {
  Scene scene = ball();
  scene.world.bounds = {{-0.02, 0.48, -0.02}, {0.02, 0.52, 0.02}};
  scene.world.on_leave = scenes::OnLeave::freeze;
  scene.fields.push_back(scenes::ImpulsesField{1, 3});
  Simulation simulation(scene, "boxstream");
  while (simulation.left() == 0) simulation.advance();
  const btVector3 frozen = body(simulation).getWorldTransform().getOrigin();
  for (int i = 0; i < 20; ++i) {
    simulation.advance();
    EXPECT_EQ(body(simulation).getLinearVelocity(), btVector3(0, 0, 0));
    EXPECT_EQ(body(simulation).getWorldTransform().getOrigin(), frozen);
  }
}

TEST(Gyroscopic, MakesAPlankTumbleThatWouldGoOnSpinning) {
  Scene scene = exhibit("gyroscopic");
  scene.time.dt = 1.0 / 240;
  const auto tilt = [](Scene description) {
    Simulation simulation(description, "boxstream");
    double most = 0;
    for (int i = 0; i < 2400; ++i) {
      simulation.advance();
      const btVector3 axis = body(simulation).getWorldTransform().getBasis().getColumn(2);
      most = std::max(most, 1 - double{axis.z()});
    }
    return most;
  };
  EXPECT_GT(tilt(scene), 1.5) << "the intermediate axis turns over";
  scene.bodies[0].traits.gyro = scenes::Gyro::off;
  EXPECT_LT(tilt(scene), 0.1);
}

}  // namespace
}  // namespace boxstream::effects_test
