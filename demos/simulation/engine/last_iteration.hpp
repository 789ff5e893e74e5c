// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

namespace boxstream::scenes {

/// Gives one of Bullet's solvers one more iteration, in which friction is gone through forth and back. Where there are
/// two rows of friction for each contact, those that come later leave the earlier ones wrong, always to the same side:
/// pyramids sink in three times as deep and never come to rest. With one direction of friction the solver is Bullet's.
template <class Solver>
class LastIteration : public Solver {
 public:
  using Solver::Solver;

 protected:
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** joints, int joint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) override {
    const btScalar residual = Solver::solveGroupCacheFriendlyIterations(bodies, body_count, manifolds, manifold_count,
                                                                        joints, joint_count, info, drawer);
    if ((info.m_solverMode & SOLVER_USE_2_FRICTION_DIRECTIONS) == 0 || !rubs()) return residual;
    const int contacts = this->m_tmpSolverContactConstraintPool.size(),
              rows = this->m_tmpSolverContactFrictionConstraintPool.size();
    for (int i = 0; i < contacts; ++i) solve_contact(i);
    for (int i = 0; i < rows; ++i) solve_friction(i);
    for (int i = rows; i-- > 0;) solve_friction(i);
    return residual;
  }

 private:
  // Solvers of multibodies have functions of the same names for rows of their own.
  using Rigid = btSequentialImpulseConstraintSolver;

  bool rubs() const {
    const btConstraintArray& friction = this->m_tmpSolverContactFrictionConstraintPool;
    for (int i = 0; i < friction.size(); ++i)
      if (friction[i].m_appliedImpulse != 0) return true;
    return false;
  }

  void solve_contact(int i) {
    const btSolverConstraint& row = this->m_tmpSolverContactConstraintPool[i];
    this->Rigid::resolveSingleConstraintRowLowerLimit(this->m_tmpSolverBodyPool[row.m_solverBodyIdA],
                                                      this->m_tmpSolverBodyPool[row.m_solverBodyIdB], row);
  }

  void solve_friction(int i) {
    btSolverConstraint& row = this->m_tmpSolverContactFrictionConstraintPool[i];
    const btScalar most = row.m_friction * this->m_tmpSolverContactConstraintPool[row.m_frictionIndex].m_appliedImpulse;
    if (!(most > 0)) return;
    row.m_lowerLimit = -most;
    row.m_upperLimit = most;
    this->Rigid::resolveSingleConstraintRowGeneric(this->m_tmpSolverBodyPool[row.m_solverBodyIdA],
                                                   this->m_tmpSolverBodyPool[row.m_solverBodyIdB], row);
  }
};

using SequentialImpulses = LastIteration<btSequentialImpulseConstraintSolver>;

}  // namespace boxstream::scenes
