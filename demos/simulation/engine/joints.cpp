// SPDX-License-Identifier: MIT
#include "simulation/engine/joints.hpp"

#include <limits>

#include <BulletDynamics/ConstraintSolver/btGearConstraint.h>
#include <btBulletDynamicsCommon.h>

#include "simulation/engine/convert.hpp"
#include "simulation/engine/spring.hpp"

namespace boxstream::scenes {
namespace {

/// Where a world frame is in the coordinates of a body.
btTransform in(const btRigidBody& body, const btTransform& frame) {
  return body.getWorldTransform().inverse() * frame;
}

/// A world frame at `pivot` whose x is `axis`.
btTransform along(const Vec3& pivot, const Vec3& axis) {
  const btVector3 x = vector(axis);
  btVector3 y, z;
  btPlaneSpace1(x, y, z);
  return btTransform(btMatrix3x3(x.x(), y.x(), z.x(), x.y(), y.y(), z.y(), x.z(), y.z(), z.z()), vector(pivot));
}

/// The same for Bullet's hinges, which turn about z.
btTransform turning_about(const Vec3& pivot, const Vec3& axis) {
  const btVector3 z = vector(axis);
  btVector3 x, y;
  btPlaneSpace1(z, x, y);
  return btTransform(btMatrix3x3(x.x(), y.x(), z.x(), x.y(), y.y(), z.y(), x.z(), y.z(), z.z()), vector(pivot));
}

btTransform at(const Vec3& pivot) {
  return btTransform(btQuaternion::getIdentity(), vector(pivot));
}

/// Bullet takes the three angles one after the other, and the one in the middle must stay within a quarter turn: the
/// axis that turns least.
RotateOrder order_for(const SixDofJoint& joint) {
  const auto range = [&](std::size_t axis) {
    const auto [low, high] = joint.angular[axis];
    return low > high ? std::numeric_limits<double>::infinity() : high - low;
  };
  if (range(1) <= range(0) && range(1) <= range(2)) return RO_XYZ;
  return range(0) <= range(2) ? RO_YXZ : RO_XZY;
}

/// Frames are made here for both bodies of every joint, from one frame of the world: then nothing is turned or moved at
/// the start. Bullet's constructors without them choose a reference of their own, and some of those for a single body
/// put it at the origin of the world.
struct MakeJoint {
  btRigidBody& a;
  btRigidBody* b;
  double dt;

  /// Bullet's body for the world, at its origin.
  btRigidBody& other() const { return b != nullptr ? *b : btTypedConstraint::getFixedBody(); }

  std::unique_ptr<btTypedConstraint> operator()(const BallJoint& joint) const {
    const btVector3 pivot = vector(joint.pivot);
    return std::make_unique<btPoint2PointConstraint>(a, other(), a.getWorldTransform().invXform(pivot),
                                                     other().getWorldTransform().invXform(pivot));
  }
  std::unique_ptr<btTypedConstraint> operator()(const HingeJoint& joint) const {
    const btTransform frame = turning_about(joint.pivot, joint.axis);
    auto hinge = std::make_unique<btHingeConstraint>(a, other(), in(a, frame), in(other(), frame));
    if (joint.limits) hinge->setLimit(real((*joint.limits)[0]), real((*joint.limits)[1]));

    // Unlike others, this motor is bounded by the impulse of a step.
    if (joint.motor && joint.motor->acts())
      hinge->enableAngularMotor(true, real(joint.motor->speed), real(joint.motor->max_force * dt));
    return hinge;
  }
  std::unique_ptr<btTypedConstraint> operator()(const ConeTwistJoint& joint) const {
    const btTransform frame = along(joint.pivot, joint.axis);
    auto cone = std::make_unique<btConeTwistConstraint>(a, other(), in(a, frame), in(other(), frame));
    cone->setLimit(real(joint.swing1), real(joint.swing2), real(joint.twist));
    return cone;
  }
  std::unique_ptr<btTypedConstraint> operator()(const SliderJoint& joint) const {
    const btTransform frame = along(joint.pivot, joint.axis);
    // The first body is the frame of reference, so that the second one moves along the axis.
    auto slider = std::make_unique<btSliderConstraint>(other(), a, in(other(), frame), in(a, frame), true);
    if (joint.limits) {
      slider->setLowerLinLimit(real((*joint.limits)[0]));
      slider->setUpperLinLimit(real((*joint.limits)[1]));
    }
    if (joint.motor && joint.motor->acts()) {
      slider->setPoweredLinMotor(true);
      slider->setTargetLinMotorVelocity(real(joint.motor->speed));
      slider->setMaxLinMotorForce(real(joint.motor->max_force));
    }
    return slider;
  }
  std::unique_ptr<btTypedConstraint> operator()(const FixedJoint& joint) const {
    const btTransform frame = at(joint.pivot);
    return std::make_unique<btFixedConstraint>(a, other(), in(a, frame), in(other(), frame));
  }
  std::unique_ptr<btTypedConstraint> operator()(const SixDofJoint& joint) const {
    const btTransform frame = at(joint.pivot);
    auto free = std::make_unique<btGeneric6DofSpring2Constraint>(other(), a, in(other(), frame), in(a, frame),
                                                                 order_for(joint));
    for (int axis = 0; axis < 3; ++axis) {
      const auto& linear = joint.linear[static_cast<std::size_t>(axis)];
      const auto& angular = joint.angular[static_cast<std::size_t>(axis)];
      free->setLimit(axis, real(linear[0]), real(linear[1]));
      // Bullet moves the second body as seen from the first, but turns the first as seen from the second.
      free->setLimit(3 + axis, real(-angular[1]), real(-angular[0]));
    }
    return free;
  }
  std::unique_ptr<btTypedConstraint> operator()(const SpringJoint& joint) const {
    const btTransform frame = at(joint.pivot);
    return std::make_unique<Spring>(other(), a, in(other(), frame), in(a, frame), real(joint.stiffness),
                                    real(joint.damping));
  }
  std::unique_ptr<btTypedConstraint> operator()(const GearJoint& joint) const {
    const auto local = [](const btRigidBody& body, const Vec3& axis) {
      return vector(axis) * body.getWorldTransform().getBasis();  // the transpose, times the axis
    };
    return std::make_unique<btGearConstraint>(a, other(), local(a, joint.axis), local(other(), joint.axis_b),
                                              real(joint.ratio));
  }
};

}  // namespace

std::unique_ptr<btTypedConstraint> make_joint(const JointValue& joint, btRigidBody& a, btRigidBody* b, double dt) {
  return std::visit(MakeJoint{a, b, dt}, joint);
}

}  // namespace boxstream::scenes
