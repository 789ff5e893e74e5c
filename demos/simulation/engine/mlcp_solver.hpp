// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <BulletDynamics/MLCPSolvers/btMLCPSolverInterface.h>

#include "formats/scene_model/settings.hpp"
#include "simulation/engine/last_iteration.hpp"

namespace boxstream::scenes {

/// Solves the rows that Bullet makes of an island's contacts and joints as one mixed linear complementarity problem,
/// A x = b + w: x are the impulses, A what an impulse of one row does to the velocity along another. Bullet's
/// btMLCPSolver does so too, but leaves rows of rolling and spinning friction out and gives up from 1000 N s on. Here
/// contacts give way a little, without which those of a box with four corners have many solutions or none.
///
/// Islands with too many rows, and those for which no solution is found, are left to sequential impulses.
class MlcpSolver : public SequentialImpulses {
 public:
  explicit MlcpSolver(SolverKind kind);

  std::uint64_t solved_rows() const { return solved_rows_; }
  std::uint64_t handed_back() const { return handed_back_; }

 protected:
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** joints, int joint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) override;

 private:
  struct Row {
    btSolverConstraint* row;
    int normal;  ///< the row of the contact that bounds this row of friction; -1: none
  };

  void collect();
  void assemble(btScalar softness_of_joints);
  bool solve_all(int iterations);
  /// The solver, with bounds of friction that are numbers.
  bool solve_bounded(int iterations);
  bool solve_once(int iterations);
  bool solve_movable(int iterations);
  bool is_solution() const;
  void apply();

  SolverKind kind_;
  std::unique_ptr<btMLCPSolverInterface> solver_;
  std::vector<Row> rows_;
  std::vector<std::vector<int>> rows_of_body_;
  btMatrixXu A_, work_;
  btVectorXu b_, x_, low_, high_;
  btAlignedObjectArray<int> dependencies_, given_;
  std::uint64_t solved_rows_ = 0, handed_back_ = 0;
};

}  // namespace boxstream::scenes
