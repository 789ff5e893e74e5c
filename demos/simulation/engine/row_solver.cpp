// SPDX-License-Identifier: MIT
#include "simulation/engine/row_solver.hpp"

#include <algorithm>
#include <array>
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

/// Whether any contact of two objects has friction: both have some.
static bool can_rub(const btPersistentManifold& manifold) {
  for (int k = 0; k < manifold.getNumContacts(); ++k)
    if (manifold.getContactPoint(k).m_combinedFriction > 0) return true;
  return false;
}

// The solver's body of a conveyor has its velocity only while rows of one manifold are made: they take what they need
// of it along. That is for rows of friction. Rows of contacts must not push along their normals, of which a manifold
// can have several, so what they took is taken back.
void RowSolver::convert_with_conveyor(btPersistentManifold& manifold, const btContactSolverInfo& info) {
  btPersistentManifold* one = &manifold;
  const int first = m_tmpSolverContactConstraintPool.size();
  // Both of Bullet's const accessors give objects that its own solver changes as well.
  const std::array<btCollisionObject*, 2> sides{const_cast<btCollisionObject*>(manifold.getBody0()),
                                                const_cast<btCollisionObject*>(manifold.getBody1())};
  const auto velocity_of = [&](std::size_t side) -> btVector3& {
    return m_tmpSolverBodyPool[getOrInitSolverBody(*sides[side], info.m_timeStep)].m_linearVelocity;
  };
  std::array<btVector3, 2> surface;
  const bool rubs = can_rub(manifold);
  for (std::size_t side = 0; side < 2; ++side) {
    const btVector3* const velocity = rubs ? surface_velocity(*sides[side]) : nullptr;
    surface[side] = velocity != nullptr ? *velocity : btVector3(0, 0, 0);
    if (velocity != nullptr) velocity_of(side) = *velocity;
  }
  btSequentialImpulseConstraintSolver::convertContacts(&one, 1, info);
  if (surface[0].isZero() && surface[1].isZero()) return;
  for (int i = first; i < m_tmpSolverContactConstraintPool.size(); ++i) {
    btSolverConstraint& row = m_tmpSolverContactConstraintPool[i];
    const btScalar closing = row.m_contactNormal1.dot(surface[0]) + row.m_contactNormal2.dot(surface[1]);
    row.m_rhs += closing * row.m_jacDiagABInv;
    ++rows_.carried;
  }
  for (std::size_t side = 0; side < 2; ++side)
    if (!surface[side].isZero()) velocity_of(side).setZero();
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
