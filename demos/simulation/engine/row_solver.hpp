// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>

#include <LinearMath/btVector3.h>

#include "formats/scene_model/settings.hpp"

class btCollisionObject;
class btConstraintSolver;

namespace boxstream::scenes {

/// Rows of the solver's matrix, summed over all islands and steps.
struct SolverRows {
  std::uint64_t contact = 0, friction = 0, rolling = 0, joint = 0;
  // Those with an impulse. Limits push one way, motors as far as their strength goes; both are joint rows as well.
  std::uint64_t acting_rolling = 0, acting_spinning = 0, acting_joint = 0, acting_limit = 0, acting_motor = 0;
  std::uint64_t pushed_apart = 0;  ///< contact rows with a split impulse
  std::uint64_t carried = 0;       ///< contact points of conveyors
  std::uint64_t other = 0;         ///< rows that another solver than Bullet's own has solved
  std::uint64_t handed_back =
      0;  ///< islands that a solver of matrices left to Bullet's own: too large, or not solvable
};

/// One of Bullet's solvers, which counts its rows and leaves those of sliding friction out if nothing calls for them:
/// Bullet would make and solve them with coefficient 0.
class RowSolver {
 public:
  virtual ~RowSolver() = default;

  virtual btConstraintSolver& bullet() = 0;

  const SolverRows& rows() const { return rows_; }
  /// Largest squared change of an impulse in the last iteration, the largest of all islands since it was last read; 0
  /// of exact solvers. Follows Bullet's residual, so it is there in any case.
  double take_residual();

  /// What touches a kinematic body is carried along its surface with a velocity of the world's axes, in m/s. The body
  /// itself stays where it is. Bullet takes velocities of kinematic bodies into account, and none of fixed ones.
  void set_surface_velocity(btCollisionObject& body, const btVector3& velocity) { conveyors_[&body] = velocity; }

 protected:
  const btVector3* surface_velocity(const btCollisionObject& body) const;

  std::unordered_map<const btCollisionObject*, btVector3> conveyors_;
  SolverRows rows_;
  double residual_ = 0;
};

/// `friction`: whether there are rows of sliding friction.
std::unique_ptr<RowSolver> make_row_solver(SolverKind kind, bool friction);

/// Whether it solves the matrix of an island's rows.
constexpr bool solves_matrices(SolverKind kind) {
  return kind != SolverKind::sequential_impulses && kind != SolverKind::nncg;
}

/// Beyond so many rows an island is left to sequential impulses: exact solvers take cubic time.
constexpr int most_rows(SolverKind kind) {
  return kind == SolverKind::projected_gauss_seidel ? 1000 : kind == SolverKind::dantzig ? 300 : 120;
}

}  // namespace boxstream::scenes
