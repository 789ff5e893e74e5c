// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <unordered_map>

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

namespace boxstream::scenes {

/// Rows of the solver's matrix, summed over all islands and steps.
struct SolverRows {
  std::uint64_t contact = 0, friction = 0, rolling = 0, joint = 0;
  // Those with an impulse. Limits push one way, motors as far as their strength goes; both are joint rows as well.
  std::uint64_t acting_rolling = 0, acting_spinning = 0, acting_joint = 0, acting_limit = 0, acting_motor = 0;
  std::uint64_t pushed_apart = 0;  ///< contact rows with a split impulse
  std::uint64_t carried = 0;       ///< contact points of conveyors
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

  /// What touches a kinematic body is carried along its surface with a velocity of the world's axes, in m/s. The body
  /// itself stays where it is. Bullet takes velocities of kinematic bodies into account, and none of fixed ones.
  void set_surface_velocity(btCollisionObject& body, const btVector3& velocity) { conveyors_[&body] = velocity; }

 private:
  void convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) override;
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** joints, int joint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) override;

  void convert_with_conveyor(btPersistentManifold& manifold, const btContactSolverInfo& info);
  const btVector3* surface_velocity(const btCollisionObject& body) const;
  void count_acting_rows(const btContactSolverInfo& info);

  bool friction_;
  std::unordered_map<const btCollisionObject*, btVector3> conveyors_;
  SolverRows rows_;
  double residual_ = 0;
};

}  // namespace boxstream::scenes
