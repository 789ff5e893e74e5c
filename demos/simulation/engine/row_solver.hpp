// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <unordered_map>

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include "simulation/engine/moved_apart.hpp"

namespace boxstream::scenes {

/// Rows of the solver's matrix, summed over all islands and steps.
struct SolverRows {
  std::uint64_t contact = 0, friction = 0, rolling = 0, joint = 0;
  // Those with an impulse. Limits push one way, motors as far as their strength goes; both are joint rows as well.
  std::uint64_t acting_rolling = 0, acting_spinning = 0, acting_joint = 0, acting_limit = 0, acting_motor = 0;
  std::uint64_t pushed_apart = 0;  ///< contact rows with a split impulse
  std::uint64_t carried = 0;       ///< contact points of conveyors
};

/// What the solver did beside taking energy out, summed over all islands and steps.
struct SolverWork {
  double motors = 0;            ///< joules, of motors of joints
  double surfaces = 0;          ///< joules, of kinematic bodies and conveyors
  double apart[3] = {0, 0, 0};  ///< kg m: masses times the ways by which split impulses moved them
};

/// Bullet's own solver, which counts its rows and leaves those of sliding friction out if nothing calls for them:
/// Bullet would make and solve them with coefficient 0.
class RowSolver final : public btSequentialImpulseConstraintSolver {
 public:
  explicit RowSolver(bool friction) : friction_(friction) {}

  const SolverRows& rows() const { return rows_; }
  /// Whether the work of steps is counted from now on.
  void count_work(bool on) { counts_work_ = on; }
  const SolverWork& work() const { return work_; }
  /// Largest squared change of an impulse in the last iteration, the largest of all islands since it was last read.
  /// Follows Bullet's residual, so it is there in any case.
  double take_residual();

  /// What touches a kinematic body is carried along its surface with a velocity of the world's axes, in m/s. The body
  /// itself stays where it is. Bullet takes velocities of kinematic bodies into account, and none of fixed ones.
  void set_surface_velocity(btCollisionObject& body, const btVector3& velocity) { conveyors_[&body] = velocity; }

  /// Where split impulses are on, which contacts get them. Those that are deeper than 4 cm, if this is not called.
  void set_moved_apart(MovedApart moved_apart) { moved_apart_ = std::move(moved_apart); }

 private:
  void convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) override;
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** joints, int joint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) override;

  void convert_with_conveyor(btPersistentManifold& manifold, const btContactSolverInfo& info);
  void move_apart(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info);
  void convert(btPersistentManifold& manifold, const btContactSolverInfo& info);
  const btVector3* surface_velocity(const btCollisionObject& body) const;
  void count_acting_rows(const btContactSolverInfo& info);
  void add_work(const btContactSolverInfo& info);

  bool friction_;
  std::unordered_map<const btCollisionObject*, btVector3> conveyors_;
  MovedApart moved_apart_;
  SolverRows rows_;
  SolverWork work_;
  bool counts_work_ = false;
  double residual_ = 0;
};

}  // namespace boxstream::scenes
