// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

namespace boxstream::scenes {

/// Gives one of Bullet's solvers a last pass over contacts. Bullet ends each iteration with friction, which leaves the
/// contacts closing: where there are two rows of it for each, as far as stacks are to sink in by three times as much
/// and never to come to rest. With one direction of friction the solver is Bullet's.
template <class Solver>
class ContactsLast : public Solver {
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
    const btConstraintArray& contacts = this->m_tmpSolverContactConstraintPool;
    for (int i = 0; i < contacts.size(); ++i) {
      const btSolverConstraint& row = contacts[i];
      this->resolveSingleConstraintRowLowerLimit(this->m_tmpSolverBodyPool[row.m_solverBodyIdA],
                                                 this->m_tmpSolverBodyPool[row.m_solverBodyIdB], row);
    }
    return residual;
  }

 private:
  bool rubs() const {
    const btConstraintArray& friction = this->m_tmpSolverContactFrictionConstraintPool;
    for (int i = 0; i < friction.size(); ++i)
      if (friction[i].m_appliedImpulse != 0) return true;
    return false;
  }
};

using SequentialImpulses = ContactsLast<btSequentialImpulseConstraintSolver>;

}  // namespace boxstream::scenes
