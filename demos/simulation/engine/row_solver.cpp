// SPDX-License-Identifier: MIT
#include "simulation/engine/row_solver.hpp"

#include <algorithm>
#include <utility>

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>

namespace boxstream::scenes {

void RowSolver::convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) {
  if (conveyors_.empty())
    btSequentialImpulseConstraintSolver::convertContacts(manifolds, count, info);
  else
    for (int i = 0; i < count; ++i) convert_with_conveyor(*manifolds[i], info);
  // Afterwards Bullet copies impulses back from the places where these rows were: the memory is still theirs, and what
  // it copies is read by rows of friction alone.
  if (!friction_) m_tmpSolverContactFrictionConstraintPool.resizeNoInitialize(0);
}

const btVector3* RowSolver::surface_velocity(const btCollisionObject& body) const {
  const auto found = conveyors_.find(&body);
  return found == conveyors_.end() ? nullptr : &found->second;
}

// The solver's body of a conveyor has its velocity only while rows of one manifold are made: they take what they need
// of it along.
void RowSolver::convert_with_conveyor(btPersistentManifold& manifold, const btContactSolverInfo& info) {
  btPersistentManifold* one = &manifold;
  // Both of Bullet's const accessors give objects that its own solver changes as well.
  btCollisionObject* const sides[] = {const_cast<btCollisionObject*>(manifold.getBody0()),
                                      const_cast<btCollisionObject*>(manifold.getBody1())};
  for (btCollisionObject* const side : sides) {
    const btVector3* const velocity = surface_velocity(*side);
    if (velocity == nullptr) continue;
    // What points into the other body would push it: end faces carry nothing away.
    btVector3 along = *velocity;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btVector3& normal = manifold.getContactPoint(k).m_normalWorldOnB;
      along -= normal * normal.dot(along);
    }
    rows_.carried += static_cast<std::uint64_t>(manifold.getNumContacts());
    const int index = getOrInitSolverBody(*side, info.m_timeStep);
    m_tmpSolverBodyPool[index].m_linearVelocity = along;
  }
  btSequentialImpulseConstraintSolver::convertContacts(&one, 1, info);
  for (btCollisionObject* const side : sides)
    if (surface_velocity(*side) != nullptr)
      m_tmpSolverBodyPool[getOrInitSolverBody(*side, info.m_timeStep)].m_linearVelocity.setZero();
}

void RowSolver::count_acting_rows(const btContactSolverInfo& info) {
  const auto faint = btScalar(1e-20);
  const btConstraintArray &contacts = m_tmpSolverContactConstraintPool,
                          &rolling = m_tmpSolverContactRollingFrictionConstraintPool,
                          &joints = m_tmpSolverNonContactConstraintPool;
  for (int i = 0; i < rolling.size(); ++i) {
    const btSolverConstraint& row = rolling[i];
    if (row.m_appliedImpulse == 0 || row.m_friction < faint) continue;
    // Rows of spinning turn about the normal of their contact.
    const btScalar cosine = row.m_relpos1CrossNormal.dot(contacts[row.m_frictionIndex].m_contactNormal1);
    ++(btFabs(cosine) > btScalar(0.9) ? rows_.acting_spinning : rows_.acting_rolling);
  }
  for (int i = 0; i < joints.size(); ++i) {
    const btSolverConstraint& row = joints[i];
    if (row.m_appliedImpulse == 0) continue;
    ++rows_.acting_joint;
    if (row.m_lowerLimit == 0 || row.m_upperLimit == 0)
      ++rows_.acting_limit;
    else if (row.m_upperLimit <
             static_cast<btTypedConstraint*>(row.m_originalContactPoint)->getBreakingImpulseThreshold())
      ++rows_.acting_motor;
  }
  if (info.m_splitImpulse == 0) return;
  for (int i = 0; i < contacts.size(); ++i) rows_.pushed_apart += contacts[i].m_appliedPushImpulse != 0;
}

btScalar RowSolver::solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                                      btPersistentManifold** manifolds, int manifold_count,
                                                      btTypedConstraint** joints, int joint_count,
                                                      const btContactSolverInfo& info, btIDebugDraw* drawer) {
  const auto size = [](const btConstraintArray& pool) { return static_cast<std::uint64_t>(pool.size()); };
  rows_.contact += size(m_tmpSolverContactConstraintPool);
  rows_.friction += size(m_tmpSolverContactFrictionConstraintPool);
  rows_.rolling += size(m_tmpSolverContactRollingFrictionConstraintPool);
  rows_.joint += size(m_tmpSolverNonContactConstraintPool);
  const btScalar result = btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyIterations(
      bodies, body_count, manifolds, manifold_count, joints, joint_count, info, drawer);
  count_acting_rows(info);
  residual_ = std::max(residual_, static_cast<double>(m_leastSquaresResidual));
  return result;
}

double RowSolver::take_residual() {
  return std::exchange(residual_, 0);
}

}  // namespace boxstream::scenes
