// SPDX-License-Identifier: MIT
#include "simulation/engine/row_solver.hpp"

#include <algorithm>
#include <utility>

namespace boxstream::scenes {

void RowSolver::convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) {
  btSequentialImpulseConstraintSolver::convertContacts(manifolds, count, info);
  // Afterwards Bullet copies impulses back from the places where these rows were: the memory is still theirs, and what
  // it copies is read by rows of friction alone.
  if (!friction_) m_tmpSolverContactFrictionConstraintPool.resizeNoInitialize(0);
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
  residual_ = std::max(residual_, static_cast<double>(m_leastSquaresResidual));
  return result;
}

double RowSolver::take_residual() {
  return std::exchange(residual_, 0);
}

}  // namespace boxstream::scenes
