// SPDX-License-Identifier: MIT
// Motion against what semi-implicit Euler gives in closed form, within 1e-4 as in Jolt's physics tests.
#include <cmath>

#include "judge.hpp"

namespace boxstream::worlds_test {
namespace {

constexpr int steps = 60;
constexpr double dt = 1.0 / 60;
constexpr double tolerance = 1e-4;

class Moves : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(All, Moves, testing::ValuesIn(kinds), [](const auto& test) { return test_name(test.param); });

/// Sum of 1, 2 ... n steps: what a constant acceleration of 1 adds up to.
double distance_of(int n) {
  return dt * dt * n * (n + 1) / 2;
}

TEST_P(Moves, FreeFall) {
  PlainWorld world(GetParam());
  world.add_ground(btVector3(0, -50, 0));
  const btRigidBody& ball = world.add(1, world.shape<btSphereShape>(btScalar(0.5)), btVector3(0, 10, 0));
  for (int i = 0; i < steps; ++i) world.step(btScalar(dt));
  const double speed = std::abs(ball.getLinearVelocity().y() + 10 * dt * steps);
  const double place = std::abs(ball.getWorldTransform().getOrigin().y() - (10 - 10 * distance_of(steps)));
  judge("free fall", "error of the velocity <= 1e-4 m/s", GetParam(), speed, speed <= tolerance);
  judge("free fall", "error of the place <= 1e-4 m", GetParam(), place, place <= tolerance);
}

TEST_P(Moves, Torque) {
  PlainWorld world(GetParam());
  world.world->setGravity(btVector3(0, 0, 0));
  btRigidBody& box =
      world.add(2, world.shape<btBoxShape>(btVector3(btScalar(0.5), btScalar(0.2), btScalar(0.3))), btVector3(0, 0, 0));
  world.add_ground(btVector3(0, -50, 0));
  const double torque = 0.25;
  const double acceleration = torque * double(box.getInvInertiaDiagLocal().z());
  for (int i = 0; i < steps; ++i) {
    box.applyTorque(btVector3(0, 0, btScalar(torque)));
    world.step(btScalar(dt));
  }
  const double speed = std::abs(box.getAngularVelocity().z() - acceleration * dt * steps);
  const btMatrix3x3& turned = box.getWorldTransform().getBasis();
  const double angle =
      std::abs(std::atan2(double(turned[1][0]), double(turned[0][0])) - acceleration * distance_of(steps));
  ASSERT_GT(acceleration * distance_of(steps), 0.3);
  ASSERT_LT(acceleration * distance_of(steps), 3);
  judge("torque", "error of the velocity of turning <= 1e-4 rad/s", GetParam(), speed, speed <= tolerance);
  judge("torque", "error of the angle <= 1e-4 rad", GetParam(), angle, angle <= tolerance);
}

TEST_P(Moves, KinematicBodyMovedByHand) {
  PlainWorld world(GetParam());
  world.world->setGravity(btVector3(0, 0, 0));
  auto* box = world.shape<btBoxShape>(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)));
  btRigidBody& hand = world.add(0, box, btVector3(0, 0, 0));
  world.world->removeRigidBody(&hand);
  hand.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  hand.setActivationState(DISABLE_DEACTIVATION);
  world.world->addRigidBody(&hand);
  btRigidBody& wheel = world.add(0, box, btVector3(0, 20, 0));
  world.world->removeRigidBody(&wheel);
  wheel.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  wheel.setActivationState(DISABLE_DEACTIVATION);
  world.world->addRigidBody(&wheel);
  btRigidBody& pushed = world.add(1, box, btVector3(btScalar(1.5), 0, 0));
  pushed.setFriction(0);
  // What it passes: pairs that must begin and end.
  for (int i = 0; i < 5; ++i) world.add(0, box, btVector3(btScalar(i), btScalar(-0.9), 3));
  for (int i = 0; i < 5; ++i) world.add(0, box, btVector3(btScalar(i), btScalar(-0.9), btScalar(0.9)));

  const double a_step = 1.5 / steps, turn = 0.05;
  double speed = 0, turning = 0;
  for (int i = 1; i <= steps; ++i) {
    hand.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(a_step * i), 0, 0)));
    wheel.setWorldTransform(btTransform(btQuaternion(btVector3(0, 1, 0), btScalar(turn * i)), btVector3(0, 20, 0)));
    world.step(btScalar(dt));
    ASSERT_TRUE(world.check_pairs()) << "step " << i;
    speed = std::max(speed, std::abs(hand.getLinearVelocity().x() - a_step / dt));
    turning = std::max(turning, std::abs(wheel.getAngularVelocity().y() - turn / dt));
  }
  const double carried = std::abs(pushed.getLinearVelocity().x() - a_step / dt);
  judge("moved by hand", "error of the velocity <= 1e-4 m/s", GetParam(), speed, speed <= tolerance);
  judge("moved by hand", "error of the velocity of turning <= 1e-4 rad/s", GetParam(), turning, turning <= tolerance);
  judge("moved by hand", "error of the velocity of what it pushes <= 1e-4 m/s", GetParam(), carried,
        carried <= tolerance);
}

}  // namespace
}  // namespace boxstream::worlds_test
