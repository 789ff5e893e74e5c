// SPDX-License-Identifier: MIT
#include "simulation/engine/spring.hpp"

#include <algorithm>

#include <btBulletDynamicsCommon.h>

namespace boxstream::scenes {
namespace {

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

}  // namespace

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

}  // namespace boxstream::scenes
