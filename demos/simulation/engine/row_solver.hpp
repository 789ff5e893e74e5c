// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

namespace boxstream::scenes {

/// Rows of the solver's matrix, summed over all islands and steps.
struct SolverRows {
  std::uint64_t contact = 0, friction = 0, rolling = 0, joint = 0;
};

/// Bullet's own solver, which counts its rows and leaves those of sliding friction out if nothing calls for them:
/// Bullet would make and solve them with coefficient 0.
class RowSolver final : public btSequentialImpulseConstraintSolver {
 public:
  explicit RowSolver(bool friction) : friction_(friction) {}

  const SolverRows& rows() const { return rows_; }
  /// Largest squared change of an impulse in the last iteration, the largest of all islands since it was last read.
  /// Follows Bullet's residual, so it is there in any case.
  double take_residual();

 private:
  void convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) override;
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** joints, int joint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) override;

  bool friction_;
  SolverRows rows_;
  double residual_ = 0;
};

}  // namespace boxstream::scenes
