// SPDX-License-Identifier: MIT
#include "simulation/engine/joints.hpp"

#include <algorithm>
#include <limits>

#include <BulletDynamics/ConstraintSolver/btGearConstraint.h>
#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>
#include <btBulletDynamicsCommon.h>

#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {
namespace {

/// A spring that pulls the origins of two frames together, as strongly as it is stretched and whatever else acts.
///
/// Bullet's own aims at the velocity that the force would give two points in space, and stops pulling there. A point
/// that is off the centre of its body, which turns as well, needs more for that velocity, and so is pulled less than it
/// should be; and where gravity pulls the same way, it does the work in the spring's place. A spring between two
/// tumbling boxes then gains three quarters of its energy within a second.
class Spring final : public btGeneric6DofSpring2Constraint {
 public:
  Spring(btRigidBody& a, btRigidBody& b, const btTransform& in_a, const btTransform& in_b, btScalar stiffness,
         btScalar damping);

  void getInfo2(btConstraintInfo2* info) override;

 private:
  btScalar stiffness_, damping_;
};

/// A velocity that no spring reaches in a step, in m/s: what a row aims at, so that its bound is what it gives.
constexpr auto out_of_reach = btScalar(1e4);

/// At most by how much an impulse of 1 N s on a point of a body changes the velocity of that point: along any axis the
/// moving, and the turning of all axes together.
btScalar most_lightness(const btRigidBody& body, const btVector3& arm) {
  btScalar turning = 0;
  for (int axis = 0; axis < 3; ++axis) {
    btVector3 unit(0, 0, 0);
    unit[axis] = 1;
    const btVector3 moment = arm.cross(unit);
    turning += moment.dot(body.getInvInertiaTensorWorld() * moment);
  }
  return body.getInvMass() + turning;
}

Spring::Spring(btRigidBody& a, btRigidBody& b, const btTransform& in_a, const btTransform& in_b, btScalar stiffness,
               btScalar damping)
    : btGeneric6DofSpring2Constraint(a, b, in_a, in_b), stiffness_(stiffness), damping_(damping) {
  for (int axis = 0; axis < 6; ++axis) setLimit(axis, 1, -1);
  for (int axis = 0; axis < 3; ++axis) {
    enableSpring(axis, true);
    setStiffness(axis, stiffness);
    setDamping(axis, damping);
    setEquilibriumPoint(axis, 0);
  }
}

void Spring::getInfo2(btConstraintInfo2* info) {
  btGeneric6DofSpring2Constraint::getInfo2(info);  // rows along the axes of the first frame, through both origins
  const btVector3 &on_a = m_calculatedTransformA.getOrigin(), &on_b = m_calculatedTransformB.getOrigin();
  const btVector3 arm_a = on_a - m_rbA.getCenterOfMassPosition(), arm_b = on_b - m_rbB.getCenterOfMassPosition();
  const btVector3 speed = m_rbA.getVelocityInLocalPoint(arm_a) - m_rbB.getVelocityInLocalPoint(arm_b);

  // Softer where steps are too long for it: by Bullet's rule for points in space, and where a step would overshoot.
  const btScalar rate = info->fps, lightness = m_rbA.getInvMass() + m_rbB.getInvMass();
  const btScalar most = most_lightness(m_rbA, arm_a) + most_lightness(m_rbB, arm_b);
  const btScalar stiffness = std::min({stiffness_, rate * rate / (16 * lightness), rate * rate / most});
  const btScalar damping = std::min(damping_, rate / most);
  const btVector3 impulse = (stiffness * (on_b - on_a) - damping * speed) / rate;

  for (int row = 0; row < 3; ++row) {
    const btScalar* const axis = info->m_J1linearAxis + row * info->rowskip;
    const btScalar along = impulse.dot(btVector3(axis[0], axis[1], axis[2]));
    const int at = row * info->rowskip;
    info->m_constraintError[at] = along < 0 ? -out_of_reach : out_of_reach;
    info->m_lowerLimit[at] = std::min(along, btScalar(0));
    info->m_upperLimit[at] = std::max(along, btScalar(0));
  }
}

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
