// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <btBulletDynamicsCommon.h>

#include "gallery.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/windward.hpp"
#include "simulation/run/simulation.hpp"

// The area that bodies turn to a flow, and what it does to them.
namespace boxstream::effects_test {
namespace {

using scenes::Scene;
using scenes::Shape;
using scenes::ShapeSet;
using scenes::ShapeValue;
using scenes::Simulation;
using scenes::Vec3;
using scenes::Windward;

constexpr double pi = std::numbers::pi;

/// Area that a shape turns to a flow along a direction: the push of a flow of 1 m/s.
double area(const ShapeValue& shape, const btVector3& direction) {
  ShapeSet shapes({{"", shape}});
  const Windward surface(shapes, 0, btTransform::getIdentity());
  const Windward::Push push = surface.push(direction.normalized(), btVector3(0, 0, 0));
  EXPECT_NEAR(push.force.cross(direction).length(), 0, 1e-4) << "along the flow";
  return double{push.force.dot(direction.normalized())};
}

const std::vector<btVector3> directions{{1, 0, 0},  {0, 1, 0}, {0, -1, 0},    {0, 0, -1},   {1, 1, 0},
                                        {1, -1, 0}, {1, 2, 3}, {-3, 0.2f, 1}, {0.1f, 5, 1}, {0.3f, -1, -0.5f}};

TEST(Windward, AreaOfEachShapeIsThatOfItsSilhouette) {
  for (const btVector3& direction : directions) {
    const btVector3 u = direction.normalized();
    const double along = std::abs(double{u.y()}), across = std::sqrt(std::max(1 - along * along, 0.0));
    const double x = std::abs(double{u.x()}), z = std::abs(double{u.z()});
    EXPECT_NEAR(area(scenes::SphereShape{0.7}, u), pi * 0.49, 1e-5);
    EXPECT_NEAR(area(scenes::BoxShape{{1, 0.1, 0.3}}, u), 4 * (x * 0.03 + along * 0.3 + z * 0.1), 1e-5);
    EXPECT_NEAR(area(scenes::CylinderShape{0.4, 1.2}, u), pi * 0.16 * along + 0.96 * across, 1e-5);
    EXPECT_NEAR(area(scenes::CapsuleShape{0.4, 1.2}, u), pi * 0.16 + 0.96 * across, 1e-5);
    EXPECT_NEAR(area(scenes::HullShape{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}}, btVector3(0, 0, 1)), 4,
                1e-4);
  }
}

/// Of a cone: its base from below, its triangle from aside, the base again from above.
TEST(Windward, AreaOfAConeIsWithinTwoPerCent) {
  const scenes::ConeShape cone{0.5, 1.3};
  EXPECT_NEAR(area(cone, {0, 1, 0}), pi * 0.25, 1e-4);
  EXPECT_NEAR(area(cone, {0, -1, 0}), pi * 0.25, 1e-4);
  for (int degrees = 0; degrees < 90; degrees += 5) {
    const double angle = degrees * pi / 180;
    EXPECT_NEAR(area(cone, btVector3(btScalar(std::cos(angle)), 0, btScalar(std::sin(angle)))), 0.65, 0.02 * 0.65)
        << degrees;
  }
}

TEST(Windward, PartsOfACompoundEachTurnTheirOwn) {
  ShapeSet shapes({{"", scenes::BoxShape{{0.1, 0.2, 0.3}}},
                   {"", scenes::CompoundShape{{{0, {1, 0, 0}, {0, 0, 0, 1}}, {0, {-1, 0, 0}, {0, 0, 0, 1}}}}}});
  const Windward surface(shapes, 1, btTransform::getIdentity());
  EXPECT_NEAR(surface.push({0, 0, 1}, {0, 0, 0}).force.z(), 2 * 0.08, 1e-5);
}

/// What looks the same from both ends turns its silhouette evenly around its middle.
TEST(Windward, AnEvenFlowDoesNotTurnASymmetricBody) {
  for (const ShapeValue& shape :
       {ShapeValue{scenes::BoxShape{{1, 0.1, 0.3}}}, ShapeValue{scenes::CylinderShape{0.4, 1.2}},
        ShapeValue{scenes::CapsuleShape{0.4, 1.2}}, ShapeValue{scenes::SphereShape{0.6}}}) {
    ShapeSet shapes({{"", shape}});
    const Windward surface(shapes, 0, btTransform::getIdentity());
    for (const btVector3& direction : directions)
      EXPECT_NEAR(surface.push(direction, {0, 0, 0}).torque.length(), 0, 2e-6 * double{direction.length2()});
  }
}

/// A frame moves and turns a shape in its body: force and torque follow.
TEST(Windward, AFrameIsWhereTheShapeIs) {
  for (const ShapeValue& shape :
       {ShapeValue{scenes::BoxShape{{1, 0.1, 0.3}}}, ShapeValue{scenes::CylinderShape{0.4, 1.2}},
        ShapeValue{scenes::CapsuleShape{0.4, 1.2}}, ShapeValue{scenes::ConeShape{0.4, 1.2}}}) {
    ShapeSet shapes({{"", shape}});
    const btTransform frame(btQuaternion(btVector3(1, 2, 2).normalized(), 1), btVector3(0.3f, -0.2f, 0.5f));
    const Windward plain(shapes, 0, btTransform::getIdentity()), moved(shapes, 0, frame);
    const btVector3 flow(1, -2, 0.5f), spin(0.4f, 0.1f, -2);
    const Windward::Push got = moved.push(flow, spin);
    // The same, seen from the shape.
    const btMatrix3x3& turn = frame.getBasis();
    const Windward::Push own = plain.push((flow - spin.cross(frame.getOrigin())) * turn, spin * turn);
    EXPECT_NEAR((turn * own.force - got.force).length(), 0, 1e-4);
    const btVector3 torque = turn * own.torque + frame.getOrigin().cross(got.force);
    EXPECT_NEAR((torque - got.torque).length(), 0, 1e-4);
  }
}

Scene in_wind(ShapeValue shape, double mass, const Vec3& velocity) {
  Scene scene = exhibit("wind");
  scene.time.dt = 1.0 / 60;
  scene.world.gravity = {0, 0, 0};
  scene.shapes = {{"sail", std::move(shape)}};
  scene.bodies.resize(1);
  scene.generators.clear();
  scene.expect = {};
  scene.bodies[0] = {};
  scene.bodies[0].traits.mass = mass;
  scene.bodies[0].traits.sleep = false;
  scene.fields = {scenes::WindField{velocity, 1.25, 0.8}};
  return scene;
}

const btRigidBody& body(const Simulation& simulation) {
  return *btRigidBody::upcast(simulation.objects()[0]);
}

TEST(Wind, PushesAPlankByTheAreaThatItTurns) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 half{0.8, 0.05, 0.25};
    Vec3 velocity{};
    velocity[static_cast<std::size_t>(axis)] = 3;
    Simulation simulation(in_wind(scenes::BoxShape{half}, 500, velocity), "boxstream");
    simulation.advance();
    const double turned = 4 * half[0] * half[1] * half[2] / half[static_cast<std::size_t>(axis)];
    const double speed = 1.25 / 2 * 0.8 * turned * 9 / 500 / 60;
    EXPECT_NEAR(body(simulation).getLinearVelocity()[axis], speed, 1e-3 * speed);
    EXPECT_NEAR(body(simulation).getAngularVelocity().length(), 0, 1e-9);
  }
}

/// A vane: a heavy bar and, far from the middle of mass, a plate. Wind turns it until the plate is to leeward.
TEST(Wind, TurnsAVaneRound) {
  Scene scene = in_wind(scenes::SphereShape{1}, 1, {0, 0, 8});
  scene.shapes = {{"small", scenes::BoxShape{{0.1, 0.2, 0.5}}},
                  {"large", scenes::BoxShape{{0.1, 0.5, 0.02}}},
                  {"vane", scenes::CompoundShape{{{0, {-0.8, 0, 0}, {0, 0, 0, 1}}, {1, {0.8, 0, 0}, {0, 0, 0, 1}}}}}};
  scene.bodies[0].traits.shape = 2;
  scene.bodies[0].traits.mass = 20;
  Simulation simulation(scene, "boxstream");
  for (int i = 0; i < 10; ++i) simulation.advance();
  // From x, where the plate is, to z.
  EXPECT_LT(body(simulation).getAngularVelocity().y(), -0.01);
}

TEST(Wind, StillAirSlowsASpinningPlateAndNotASpinningBall) {
  Scene scene = in_wind(scenes::BoxShape{{0.5, 0.02, 0.3}}, 2, {0, 0, 0});
  scene.bodies[0].spin = {0, 0, 12};
  scene.time.dt = 1.0 / 480;
  Simulation plate(scene, "boxstream");
  for (int i = 0; i < 480; ++i) plate.advance();
  // Two halves of the plate, each pushed by its own speed squared: torque = factor * 4 half_z * (half_x^4 / 4) *
  // spin^2. 1 / spin grows by torque over moment. Two spots along a face that the air meets from both sides feel 77 %
  // of that.
  const double torque = 1.25 / 2 * 0.8 * 4 * 0.3 * std::pow(0.5, 4) / 4;
  const double moment = 2.0 / 3 * (0.5 * 0.5 + 0.02 * 0.02);
  EXPECT_NEAR(body(plate).getAngularVelocity().z(), 1 / (1.0 / 12 + 0.77 * torque / moment), 0.05);
  scene.shapes[0].value = scenes::SphereShape{0.5};
  Simulation ball(scene, "boxstream");
  for (int i = 0; i < 480; ++i) ball.advance();
  EXPECT_NEAR(body(ball).getAngularVelocity().z(), 12, 1e-4);
}

TEST(Wind, ThatIsAStormDoesNotThrowLightBodiesAround) {
  for (const ShapeValue& shape :
       {ShapeValue{scenes::BoxShape{{1, 0.05, 0.3}}}, ShapeValue{scenes::CapsuleShape{0.1, 1.2}},
        ShapeValue{scenes::ConeShape{0.4, 0.9}}, ShapeValue{scenes::CylinderShape{0.5, 0.1}}}) {
    Scene scene = in_wind(shape, 1e-3, {40, 3, 0});
    scene.bodies[0].spin = {1, 3, 2};
    Simulation simulation(scene, "boxstream");
    for (int i = 0; i < 600; ++i) {
      simulation.advance();
      ASSERT_TRUE(simulation.is_finite());
      ASSERT_LT(body(simulation).getLinearVelocity().length(), 100);
      ASSERT_LT(body(simulation).getAngularVelocity().length(), 1000);
    }
    EXPECT_NEAR(body(simulation).getLinearVelocity().x(), 40, 4);
  }
}

/// Falls as fast as its weight is the drag of the area that it turns: a plate that falls flat.
TEST(Drag, ByAreaEndsAtTerminalSpeed) {
  Scene scene = in_wind(scenes::BoxShape{{0.4, 0.01, 0.6}}, 3, {0, 0, 0});
  scene.world.gravity = {0, -9.81, 0};
  scenes::DragField drag;
  drag.density = 1.2, drag.coefficient = 1.1;
  scene.fields = {drag};
  Simulation simulation(scene, "boxstream");
  for (int i = 0; i < 1200; ++i) simulation.advance();
  const double terminal = std::sqrt(3 * 9.81 / (1.2 / 2 * 1.1 * 0.96));
  EXPECT_NEAR(body(simulation).getLinearVelocity().y(), -terminal, 1e-3 * terminal);
}

}  // namespace
}  // namespace boxstream::effects_test
