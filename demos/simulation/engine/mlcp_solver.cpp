// SPDX-License-Identifier: MIT
#include "simulation/engine/mlcp_solver.hpp"

#include "simulation/engine/row_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btLemkeSolver.h>
#include <BulletDynamics/MLCPSolvers/btSolveProjectedGaussSeidel.h>

namespace boxstream::scenes {
namespace {

/// By what share of their own entry of the matrix contacts give way: too little to be seen, enough for points in one
/// plane to share their load in one way only.
constexpr auto softness_of_contacts = btScalar(1e-5);

/// Bullet's Lemke inverts the matrix in floats, without pivots.
constexpr auto softness_for_lemke = btScalar(1e-3);

/// Friction that is there only for rows to be made.
constexpr auto faint_friction = btScalar(1e-20);

/// Joints that close a loop have rows that say the same. Only where these have no solution do joints give way.
constexpr auto softness_of_loops = btScalar(1e-6);

/// Bullet's, without the bound of 1000 N s.
class Dantzig final : public btDantzigSolver {
 public:
  Dantzig() { m_acceptableUpperLimitSolution = std::numeric_limits<btScalar>::infinity(); }
};

std::unique_ptr<btMLCPSolverInterface> make_solver(SolverKind kind) {
  if (kind == SolverKind::dantzig) return std::make_unique<Dantzig>();
  if (kind == SolverKind::lemke) {
    auto solver = std::make_unique<btLemkeSolver>();
    solver->m_maxValue = std::numeric_limits<btScalar>::max();
    return solver;
  }
  return std::make_unique<btSolveProjectedGaussSeidel>();
}

/// What an impulse of one row does to the velocity along another, by the body of one side of each.
struct Side {
  const btVector3 &linear, &angular, &turned;
};
Side side_of(const btSolverConstraint& row, int body) {
  if (row.m_solverBodyIdA == body) return {row.m_contactNormal1, row.m_relpos1CrossNormal, row.m_angularComponentA};
  return {row.m_contactNormal2, row.m_relpos2CrossNormal, row.m_angularComponentB};
}
btScalar coupling(const btSolverBody& body, const Side& a, const Side& b) {
  return a.linear.dot(b.linear * body.internalGetInvMass()) + a.angular.dot(b.turned * body.m_angularFactor);
}

bool is_finite(const btVectorXu& values) {
  for (int i = 0; i < values.rows(); ++i)
    if (!std::isfinite(values[i])) return false;
  return true;
}

}  // namespace

MlcpSolver::MlcpSolver(SolverKind kind) : kind_(kind), solver_(make_solver(kind)) {}

void MlcpSolver::collect() {
  rows_.clear();
  const auto add = [&](btConstraintArray& pool, int first_contact) {
    for (int i = 0; i < pool.size(); ++i) {
      // What cannot push would only change how others are rounded.
      if (first_contact >= 0 && pool[i].m_friction < faint_friction) continue;
      rows_.push_back({&pool[i], first_contact < 0 ? -1 : first_contact + pool[i].m_frictionIndex});
    }
  };
  // Joints without bounds first: what starts with them is factorised once.
  add(m_tmpSolverNonContactConstraintPool, -1);
  const int first_contact = static_cast<int>(rows_.size());
  add(m_tmpSolverContactConstraintPool, -1);
  add(m_tmpSolverContactFrictionConstraintPool, first_contact);
  add(m_tmpSolverContactRollingFrictionConstraintPool, first_contact);
}

void MlcpSolver::assemble(btScalar softness_of_joints) {
  const int n = static_cast<int>(rows_.size());
  A_.resize(n, n);
  A_.setZero();
  for (btVectorXu* const vector : {&b_, &x_, &low_, &high_}) vector->resize(n);
  dependencies_.resize(n);

  for (std::vector<int>& rows : rows_of_body_) rows.clear();
  rows_of_body_.resize(std::max(rows_of_body_.size(), static_cast<std::size_t>(m_tmpSolverBodyPool.size())));
  for (int i = 0; i < n; ++i) {
    const btSolverConstraint& row = *rows_[static_cast<std::size_t>(i)].row;
    for (const int body : {row.m_solverBodyIdA, row.m_solverBodyIdB})
      if (m_tmpSolverBodyPool[body].m_originalBody != nullptr)
        rows_of_body_[static_cast<std::size_t>(body)].push_back(i);
  }
  for (int body = 0; body < m_tmpSolverBodyPool.size(); ++body) {
    const std::vector<int>& touching = rows_of_body_[static_cast<std::size_t>(body)];
    for (const int i : touching)
      for (const int j : touching)
        A_.setElem(
            i, j,
            A_(i, j) + coupling(m_tmpSolverBodyPool[body], side_of(*rows_[static_cast<std::size_t>(i)].row, body),
                                side_of(*rows_[static_cast<std::size_t>(j)].row, body)));
  }

  const int joints = m_tmpSolverNonContactConstraintPool.size(), contacts = m_tmpSolverContactConstraintPool.size();
  for (int i = 0; i < n; ++i) {
    const auto& [row, normal] = rows_[static_cast<std::size_t>(i)];
    const btScalar scale = row->m_jacDiagABInv;
    const bool works = scale > 0 && A_(i, i) > 0;
    b_[i] = works ? row->m_rhs / scale : btScalar(0);
    const btScalar softness = i < joints                   ? softness_of_joints
                              : kind_ == SolverKind::lemke ? softness_for_lemke
                                                           : softness_of_contacts;
    A_.setElem(i, i, works ? A_(i, i) * (1 + softness) + row->m_cfm / scale : btScalar(1));
    x_[i] = row->m_appliedImpulse;
    dependencies_[i] = normal;
    if (normal >= 0) {
      low_[i] = -row->m_friction;
      high_[i] = row->m_friction;
    } else if (i >= joints && i < joints + contacts) {
      low_[i] = 0;
      high_[i] = BT_INFINITY;
    } else {
      // Bullet's bound of rows that have none.
      low_[i] = row->m_lowerLimit <= -SIMD_INFINITY ? -BT_INFINITY : row->m_lowerLimit;
      high_[i] = row->m_upperLimit >= SIMD_INFINITY ? BT_INFINITY : row->m_upperLimit;
    }
  }
}

bool MlcpSolver::solve_once(int iterations) {
  work_ = A_;  // solvers change it
  given_.copyFromArray(dependencies_);
  return solver_->solveMLCP(work_, b_, x_, low_, high_, given_, iterations) && is_finite(x_);
}

/// The same of the rows that can have an impulse: those whose bounds are both 0 make Lemke's method leave all bounds.
bool MlcpSolver::solve_movable(int iterations) {
  std::vector<int> movable;
  for (int i = 0; i < b_.rows(); ++i)
    if (low_[i] < high_[i]) movable.push_back(i);
  const int n = static_cast<int>(movable.size());
  if (n == b_.rows()) return solve_once(iterations);
  work_.resize(n, n);
  btVectorXu b, x, low, high;
  for (btVectorXu* const vector : {&b, &x, &low, &high}) vector->resize(n);
  given_.resize(0);
  for (int i = 0; i < n; ++i) {
    const int row = movable[static_cast<std::size_t>(i)];
    for (int j = 0; j < n; ++j) work_.setElem(i, j, A_(row, movable[static_cast<std::size_t>(j)]));
    b[i] = b_[row], x[i] = x_[row], low[i] = low_[row], high[i] = high_[row];
    given_.push_back(-1);
  }
  x_.setZero();
  if (!solver_->solveMLCP(work_, b, x, low, high, given_, iterations) || !is_finite(x)) return false;
  for (int i = 0; i < n; ++i) x_[movable[static_cast<std::size_t>(i)]] = x[i];
  return true;
}

/// Whether what was found is a solution: rows that are not at a bound leave no velocity, those at one push only, and
/// none is beyond its bounds.
bool MlcpSolver::is_solution() const {
  btScalar most = 0;
  for (int i = 0; i < b_.rows(); ++i) most = std::max(most, btFabs(b_[i]));
  const btScalar faint = most / 1000 + btScalar(1e-5);
  for (int i = 0; i < b_.rows(); ++i) {
    btScalar left = -b_[i];
    for (int j = 0; j < b_.rows(); ++j) left += A_(i, j) * x_[j];
    const bool at_low = x_[i] <= low_[i] + faint / A_(i, i), at_high = x_[i] >= high_[i] - faint / A_(i, i);
    if ((left > faint && !at_low) || (left < -faint && !at_high)) return false;
    if (x_[i] < low_[i] - faint / A_(i, i) || x_[i] > high_[i] + faint / A_(i, i)) return false;
  }
  return true;
}

// Lemke's method takes numbers for bounds, and friction is bounded by what is yet to be found: three times, from what
// the contacts bore in the step before. Those that bore nothing are without friction at first.
bool MlcpSolver::solve_bounded(int iterations) {
  constexpr int times = 3;
  const int n = b_.rows();
  btScalar most = 0;
  for (int i = 0; i < n; ++i) most = std::max(most, std::max(btFabs(x_[i]), btFabs(b_[i] / A_(i, i))));
  const btScalar unbounded = 1000 * static_cast<btScalar>(n) * std::max(most, btScalar(1e-6));
  const btVectorXu low = low_, high = high_;
  const btAlignedObjectArray<int> dependencies = dependencies_;
  bool solved = true;
  for (int time = 0; time < times && solved; ++time) {
    for (int i = 0; i < n; ++i) {
      const btScalar by = dependencies[i] >= 0 ? std::max(x_[dependencies[i]], btScalar(0)) : btScalar(1);
      low_[i] = std::max(low[i] * by, -unbounded);
      high_[i] = std::min(high[i] * by, unbounded);
      dependencies_[i] = -1;
    }
    solved = solve_movable(iterations) && is_solution();
  }
  dependencies_ = dependencies;
  low_ = low;
  high_ = high;
  return solved;
}

bool MlcpSolver::solve_all(int iterations) {
  const auto solve = [&] { return kind_ == SolverKind::lemke ? solve_bounded(iterations) : solve_once(iterations); };
  assemble(0);
  if (solve()) return true;
  if (m_tmpSolverNonContactConstraintPool.size() == 0) return false;
  assemble(softness_of_loops);
  return solve();
}

void MlcpSolver::apply() {
  // Bullet has begun with the impulses of the step before; what is applied here is all of it.
  for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i) {
    m_tmpSolverBodyPool[i].internalGetDeltaLinearVelocity().setZero();
    m_tmpSolverBodyPool[i].internalGetDeltaAngularVelocity().setZero();
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    btSolverConstraint& row = *rows_[i].row;
    row.m_appliedImpulse = x_[static_cast<int>(i)];
    btSolverBody &a = m_tmpSolverBodyPool[row.m_solverBodyIdA], &b = m_tmpSolverBodyPool[row.m_solverBodyIdB];
    a.internalApplyImpulse(row.m_contactNormal1 * a.internalGetInvMass(), row.m_angularComponentA,
                           row.m_appliedImpulse);
    b.internalApplyImpulse(row.m_contactNormal2 * b.internalGetInvMass(), row.m_angularComponentB,
                           row.m_appliedImpulse);
  }
}

btScalar MlcpSolver::solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                                       btPersistentManifold** manifolds, int manifold_count,
                                                       btTypedConstraint** joints, int joint_count,
                                                       const btContactSolverInfo& info, btIDebugDraw* drawer) {
  collect();
  if (static_cast<int>(rows_.size()) <= most_rows(kind_) && solve_all(info.m_numIterations)) {
    solveGroupCacheFriendlySplitImpulseIterations(bodies, body_count, manifolds, manifold_count, joints, joint_count,
                                                  info, drawer);
    apply();
    solved_rows_ += rows_.size();
    m_leastSquaresResidual = 0;
    return 0;
  }
  ++handed_back_;
  return SequentialImpulses::solveGroupCacheFriendlyIterations(bodies, body_count, manifolds, manifold_count, joints,
                                                               joint_count, info, drawer);
}

}  // namespace boxstream::scenes
