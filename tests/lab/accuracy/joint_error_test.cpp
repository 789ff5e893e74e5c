// SPDX-License-Identifier: MIT
#include "simulation/run/joint_error.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include <btBulletDynamicsCommon.h>

namespace boxstream::accuracy_test {
namespace {

/// Two bodies, one at (0, 0, 0) and one at (10, 0, 0), and a joint between them as it is before any step.
class JointError : public testing::Test {
 protected:
  JointError() { b_.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(10, 0, 0))); }

  scenes::JointError of(btTypedConstraint& joint) {
    world_.addConstraint(&joint);
    const scenes::JointError error = scenes::joint_error(world_);
    world_.removeConstraint(&joint);
    return error;
  }

  static constexpr btScalar degree = static_cast<btScalar>(std::numbers::pi / 180);
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btSphereShape ball_{1};
  btRigidBody a_{1, nullptr, &ball_, btVector3(1, 1, 1)}, b_{1, nullptr, &ball_, btVector3(1, 1, 1)};
};

TEST_F(JointError, OfABallJointIsTheGapOfItsEnds) {
  btPoint2PointConstraint joint(a_, b_, btVector3(3, 0, 0), btVector3(-7, 4, 0));
  EXPECT_NEAR(of(joint).distance, 4, 1e-6);
  btPoint2PointConstraint to_the_world(a_, btVector3(3, 4, 0));
  a_.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 2)));
  EXPECT_NEAR(of(to_the_world).distance, 2, 1e-6);
}

TEST_F(JointError, OfAHingeIsAlsoTheAngleOfItsAxes) {
  btHingeConstraint joint(a_, b_, btVector3(5, 0, 0), btVector3(-5, 0, 0), btVector3(0, 0, 1), btVector3(0, 0, 1));
  EXPECT_NEAR(of(joint).distance, 0, 1e-6);
  EXPECT_NEAR(of(joint).degrees, 0, 1e-3);
  // Turning about the axis is what a hinge is for.
  a_.setWorldTransform(btTransform(btQuaternion(btVector3(0, 0, 1), 90 * degree), btVector3(5, -5, 0)));
  EXPECT_NEAR(of(joint).distance, 0, 1e-5);
  EXPECT_NEAR(of(joint).degrees, 0, 1e-3);
  a_.setWorldTransform(btTransform(btQuaternion(btVector3(1, 0, 0), 30 * degree), btVector3(0, 0, 0)));
  EXPECT_NEAR(of(joint).degrees, 30, 1e-3);
}

TEST_F(JointError, OfAFixedJointIsTheAngleOfItsSides) {
  btTransform middle_a = btTransform::getIdentity(), middle_b = btTransform::getIdentity();
  middle_a.setOrigin(btVector3(5, 0, 0));
  middle_b.setOrigin(btVector3(-5, 0, 0));
  btFixedConstraint joint(a_, b_, middle_a, middle_b);
  EXPECT_NEAR(of(joint).distance, 0, 1e-6);
  a_.setWorldTransform(btTransform(btQuaternion(btVector3(1, 0, 0), 20 * degree), btVector3(0, 3, 0)));
  EXPECT_NEAR(of(joint).distance, 3, 1e-5);
  EXPECT_NEAR(of(joint).degrees, 20, 1e-3);
}

TEST_F(JointError, OfASliderIsNotAsked) {
  btSliderConstraint joint(a_, b_, btTransform::getIdentity(), btTransform::getIdentity(), true);
  EXPECT_EQ(of(joint).distance, 0);
}

}  // namespace
}  // namespace boxstream::accuracy_test
