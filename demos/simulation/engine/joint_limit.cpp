// SPDX-License-Identifier: MIT
#include "simulation/engine/joint_limit.hpp"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

namespace boxstream::scenes {

JointLimit::JointLimit(btMultiBody& multibody, int link, btScalar low, btScalar high)
    : btMultiBodyConstraint(&multibody, nullptr, link, -1, 2, true, MULTIBODY_CONSTRAINT_LIMIT),
      low_(low),
      high_(high) {
  m_maxAppliedImpulse = BT_LARGE_FLOAT;
}

void JointLimit::finalizeMultiDof() {
  allocateJacobiansMultiDof();
  const int coordinate = 6 + m_bodyA->getLink(m_linkA).m_dofOffset;
  jacobianA(0)[coordinate] = 1;
  jacobianA(1)[coordinate] = -1;
  m_numDofsFinalized = m_jacSizeBoth;
}

int JointLimit::getIslandIdA() const {
  return m_bodyA->getLink(m_linkA).m_collider->getIslandTag();
}

// A row for each end: the joint comes no nearer to it in a step than it is away, and leaves a fifth (or what the scene
// says) of the way that it is beyond.
void JointLimit::createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                                      const btContactSolverInfo& info) {
  const btVector3 none(0, 0, 0);
  const btScalar place = m_bodyA->getJointPos(m_linkA), speed = m_bodyA->getJointVel(m_linkA);
  for (int end = 0; end < 2; ++end) {
    const btScalar room = end == 0 ? place - low_ : high_ - place, closing = end == 0 ? -speed : speed;
    if (closing * info.m_timeStep < room) {
      internalSetAppliedImpulse(end, 0);
      continue;
    }
    btMultiBodySolverConstraint& row = rows.expandNonInitializing();
    row.m_orgConstraint = this;
    row.m_orgDofIndex = end;
    row.m_multiBodyB = nullptr;
    row.m_solverBodyIdA = row.m_solverBodyIdB = data.m_fixedBodyId;
    const btScalar share = room > 0 ? 1 : info.m_erp;
    fillMultiBodyConstraint(row, data, jacobianA(end), nullptr, none, none, none, none, 0, info, 0, m_maxAppliedImpulse,
                            false, 1, false, -room * share / info.m_timeStep);
  }
}

}  // namespace boxstream::scenes
