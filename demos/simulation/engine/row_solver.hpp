// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include <LinearMath/btVector3.h>

#include "formats/scene_model/settings.hpp"
#include "simulation/engine/moved_apart.hpp"
#include "simulation/engine/solver_work.hpp"

class btCollisionObject;
class btConstraintSolver;
class btRigidBody;

namespace boxstream::scenes {

/// Rows of the solver's matrix, summed over all islands and steps.
struct SolverRows {
  std::uint64_t contact = 0, friction = 0, rolling = 0, joint = 0;
  // Those with an impulse. Limits push one way, motors as far as their strength goes; both are joint rows as well.
  std::uint64_t acting_rolling = 0, acting_spinning = 0, acting_joint = 0, acting_limit = 0, acting_motor = 0;
  std::uint64_t pushed_apart = 0;  ///< contact rows with a split impulse
  std::uint64_t carried = 0;       ///< contact points of conveyors
  std::uint64_t links = 0;         ///< links of multibodies that have moved: what holds them has no row
  std::uint64_t other = 0;         ///< rows that another solver than Bullet's own has solved
  /// Islands that a solver of matrices left to Bullet's own: too large, or not solvable.
  std::uint64_t handed_back = 0;
};

/// One of Bullet's solvers, which counts its rows and leaves those of sliding friction out if nothing calls for them:
/// Bullet would make and solve them with coefficient 0.
class RowSolver {
 public:
  virtual ~RowSolver() = default;

  virtual btConstraintSolver& bullet() = 0;

  const SolverRows& rows() const { return rows_; }
  /// From now on the work of steps is counted, and `acting_on` is called for each body that a row pushes. Null: no
  /// more.
  void count_work(const std::function<void(const btRigidBody&)>* acting_on) { acting_on_ = acting_on; }
  const SolverWork& work() const { return work_; }
  /// Work in joules of motors that it cannot see: those of multibodies.
  void add_work_of_motors(double joules) {
    if (acting_on_ != nullptr) work_.motors += joules;
  }
  /// Likewise of conveyors.
  void add_work_of_surfaces(double joules) {
    if (acting_on_ != nullptr) work_.surfaces += joules;
  }
  /// Links that moved without a row for what holds them.
  void add_links(std::uint64_t count) { rows_.links += count; }
  /// Largest squared change of an impulse in the last iteration, the largest of all islands since it was last read; 0
  /// of exact solvers. Follows Bullet's residual, so it is there in any case.
  double take_residual();

  /// Bullet takes bodies of more than about ten thousand tons for fixed ones, and lets them fall through each other.
  void expect_heavy_bodies() { has_heavy_ = true; }

  /// What touches a kinematic body is carried along its surface with a velocity of the world's axes, in m/s. The body
  /// itself stays where it is. Bullet takes velocities of kinematic bodies into account, and none of fixed ones.
  void set_surface_velocity(btCollisionObject& body, const btVector3& velocity) { conveyors_[&body] = velocity; }
  const Conveyors& conveyors() const { return conveyors_; }

  /// Where split impulses are on, which contacts get them. Those that are deeper than 4 cm, if this is not called.
  void set_moved_apart(MovedApart moved_apart) { moved_apart_ = std::move(moved_apart); }

 protected:
  Conveyors conveyors_;
  MovedApart moved_apart_;
  bool has_heavy_ = false;
  SolverRows rows_;
  SolverWork work_;
  const std::function<void(const btRigidBody&)>* acting_on_ = nullptr;
  double residual_ = 0;
};

/// `friction`: whether there are rows of sliding friction.
std::unique_ptr<RowSolver> make_row_solver(SolverKind kind, bool friction);

/// Whether it solves the matrix of an island's rows.
constexpr bool solves_matrices(SolverKind kind) {
  return kind == SolverKind::dantzig || kind == SolverKind::lemke || kind == SolverKind::projected_gauss_seidel;
}

/// Beyond so many rows an island is left to sequential impulses: exact solvers take cubic time.
constexpr int most_rows(SolverKind kind) {
  return kind == SolverKind::projected_gauss_seidel ? 1000 : kind == SolverKind::dantzig ? 300 : 120;
}

}  // namespace boxstream::scenes
