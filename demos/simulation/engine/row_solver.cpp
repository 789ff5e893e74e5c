// SPDX-License-Identifier: MIT
#include "simulation/engine/row_solver.hpp"

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>
#include <vector>

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/ConstraintSolver/btNNCGConstraintSolver.h>
#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>

#include "simulation/engine/last_iteration.hpp"
#include "simulation/engine/mlcp_solver.hpp"

namespace boxstream::scenes {
namespace {

/// Gives access to the rows of multibodies, which their solver keeps beside those of rigid bodies.
class MultibodySolver : public LastIteration<btMultiBodyConstraintSolver> {
 protected:
  /// While it lives, converting contacts does not make the rows of joints as well.
  class ContactsAlone {
   public:
    explicit ContactsAlone(MultibodySolver& solver)
        : solver_(solver), joints_(std::exchange(solver.m_tmpNumMultiBodyConstraints, 0)) {}
    ~ContactsAlone() { solver_.m_tmpNumMultiBodyConstraints = joints_; }
    ContactsAlone(const ContactsAlone&) = delete;
    ContactsAlone& operator=(const ContactsAlone&) = delete;

   private:
    MultibodySolver& solver_;
    int joints_;
  };

  void count_all(SolverRows& rows) const {
    const auto size = [](const btMultiBodyConstraintArray& pool) { return static_cast<std::uint64_t>(pool.size()); };
    rows.contact += size(m_multiBodyNormalContactConstraints);
    rows.friction += size(m_multiBodyFrictionContactConstraints);
    rows.rolling +=
        size(m_multiBodyTorsionalFrictionContactConstraints) + size(m_multiBodySpinningFrictionContactConstraints);
    rows.joint += size(m_multiBodyNonContactConstraints);
  }

  /// Multibodies that contacts or ends of joints push are marked: their user index is 1.
  void count_acting(SolverRows& rows) const {
    for (int i = 0; i < m_multiBodyNormalContactConstraints.size(); ++i) {
      const btMultiBodySolverConstraint& row = m_multiBodyNormalContactConstraints[i];
      if (row.m_appliedImpulse == 0) continue;
      for (btMultiBody* const pushed : {row.m_multiBodyA, row.m_multiBodyB})
        if (pushed != nullptr) pushed->setUserIndex(1);
    }
    const auto acting = [](const btMultiBodyConstraintArray& pool) {
      std::uint64_t count = 0;
      for (int i = 0; i < pool.size(); ++i) count += pool[i].m_appliedImpulse != 0 && pool[i].m_friction > 1e-20F;
      return count;
    };
    rows.acting_rolling += acting(m_multiBodyTorsionalFrictionContactConstraints);
    rows.acting_spinning += acting(m_multiBodySpinningFrictionContactConstraints);
    for (int i = 0; i < m_multiBodyNonContactConstraints.size(); ++i) {
      const btMultiBodySolverConstraint& row = m_multiBodyNonContactConstraints[i];
      if (row.m_appliedImpulse == 0) continue;
      ++rows.acting_joint;
      if (row.m_orgConstraint->getConstraintType() == MULTIBODY_CONSTRAINT_LIMIT) row.m_multiBodyA->setUserIndex(1);
      rows.acting_limit += row.m_orgConstraint->getConstraintType() == MULTIBODY_CONSTRAINT_LIMIT;
      rows.acting_motor += row.m_orgConstraint->getConstraintType() == MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR;
    }
  }

  /// Joules that kinematic bodies give to links that they push.
  double work_of_surfaces() const {
    double work = 0;
    for (const auto* const pool :
         {&m_multiBodyNormalContactConstraints, &m_multiBodyFrictionContactConstraints,
          &m_multiBodyTorsionalFrictionContactConstraints, &m_multiBodySpinningFrictionContactConstraints})
      for (int i = 0; i < pool->size(); ++i) {
        const btMultiBodySolverConstraint& row = (*pool)[i];
        const auto of = [&](const btMultiBody* multibody, int id, const btVector3& normal, const btVector3& arm) {
          if (multibody != nullptr) return 0.0;
          const btSolverBody& body = m_tmpSolverBodyPool[id];
          if (body.m_originalBody == nullptr || !body.m_originalBody->isKinematicObject()) return 0.0;
          return -double{row.m_appliedImpulse} *
                 double{normal.dot(body.m_linearVelocity) + arm.dot(body.m_angularVelocity)};
        };
        if (row.m_appliedImpulse == 0) continue;
        work += of(row.m_multiBodyA, row.m_solverBodyIdA, row.m_contactNormal1, row.m_relpos1CrossNormal) +
                of(row.m_multiBodyB, row.m_solverBodyIdB, row.m_contactNormal2, row.m_relpos2CrossNormal);
      }
    return work;
  }
};

using ConjugateGradients = LastIteration<btNNCGConstraintSolver>;

/// Adds the counting to one of Bullet's solvers, which all have the rows of btSequentialImpulseConstraintSolver.
template <class Solver>
class Counted final : public Solver, public RowSolver {
 public:
  template <class... Arguments>
  explicit Counted(bool friction, Arguments... arguments) : Solver(arguments...), friction_(friction) {
    // Its steps take friction beyond its bounds.
    if constexpr (std::is_same_v<Solver, ConjugateGradients>) this->m_onlyForNoneContact = true;
  }

  btConstraintSolver& bullet() override { return *this; }

 private:
  void convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) override;
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** joints, int joint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) override;

  static constexpr bool has_multibodies = std::is_same_v<Solver, MultibodySolver>;

  void convert_all(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info);
  void convert_contacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info);
  void move_apart(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info);
  void convert(btPersistentManifold& manifold, const btContactSolverInfo& info);
  void convert_with_conveyor(btPersistentManifold& manifold, const btContactSolverInfo& info);
  void count_acting_rows(const btContactSolverInfo& info);

  bool friction_;
};

template <class Solver>
void Counted<Solver>::convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) {
  if (!has_heavy_) return convert_all(manifolds, count, info);
  // While rows are made, inverse masses that Bullet would take for 0 are larger by a power of two; so are the
  // velocities that come of the impulses of the step before, all of which the rows have.
  constexpr btScalar larger = 16777216;
  std::vector<int> heavy;
  for (int i = 0; i < this->m_tmpSolverBodyPool.size(); ++i) {
    btSolverBody& body = this->m_tmpSolverBodyPool[i];
    if (body.m_originalBody == nullptr || body.m_invMass.isZero() || !body.m_invMass.fuzzyZero()) continue;
    body.m_invMass *= larger;
    heavy.push_back(i);
  }
  convert_all(manifolds, count, info);
  for (const int i : heavy) {
    this->m_tmpSolverBodyPool[i].m_invMass /= larger;
    this->m_tmpSolverBodyPool[i].m_deltaLinearVelocity /= larger;
  }
}

template <class Solver>
void Counted<Solver>::convert_contacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) {
  if (info.m_splitImpulse != 0) {
    move_apart(manifolds, count, info);
  } else if (!conveyors_.empty()) {
    for (int i = 0; i < count; ++i) convert(*manifolds[i], info);
  } else {
    Solver::convertContacts(manifolds, count, info);
  }
}

template <class Solver>
void Counted<Solver>::convert_all(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) {
  if constexpr (has_multibodies) {
    {
      const typename Solver::ContactsAlone alone(*this);
      convert_contacts(manifolds, count, info);
    }
    // Rows of joints have no split impulse, and Bullet would leave what is deep to it.
    btContactSolverInfo of_joints = info;
    of_joints.m_splitImpulse = 0;
    Solver::convertContacts(manifolds, 0, of_joints);
  } else {
    convert_contacts(manifolds, count, info);
  }
  // Afterwards Bullet copies impulses back from the places where these rows were: the memory is still theirs, and what
  // it copies is read by rows of friction alone.
  if (!friction_) this->m_tmpSolverContactFrictionConstraintPool.resizeNoInitialize(0);
}

const btManifoldPoint& point_of(const btSolverConstraint& row) {
  return *static_cast<const btManifoldPoint*>(row.m_originalContactPoint);
}

/// Whether a body of a manifold may be swept. It comes deep within one step; while it is there, gravity draws it on.
bool is_swept(const btPersistentManifold& manifold) {
  return manifold.getBody0()->getCcdSquareMotionThreshold() > 0 ||
         manifold.getBody1()->getCcdSquareMotionThreshold() > 0;
}

// Bullet moves bodies apart as if those contacts were alone that are to be moved, and pushes what lies on a floor
// through it. Here the others hold: nothing is moved further than they have room.
template <class Solver>
void Counted<Solver>::move_apart(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) {
  btConstraintArray& rows = this->m_tmpSolverContactConstraintPool;
  btContactSolverInfo of_one = info;  // each has a bound of its own
  bool any = false;
  for (int i = 0; i < count; ++i) {
    of_one.m_splitImpulsePenetrationThreshold = moved_apart_.threshold(*manifolds[i]);
    const int first = rows.size();
    convert(*manifolds[i], of_one);
    // In a single step, and not by a share of the depth in each.
    const btScalar faster = is_swept(*manifolds[i]) && info.m_erp2 > 0 ? 1 / info.m_erp2 : 1;
    const btScalar most = moved_apart_.deepest_push(*manifolds[i]);
    for (int k = first; k < rows.size(); ++k) {
      btSolverConstraint& row = rows[k];
      any = any || row.m_rhsPenetration != 0;
      row.m_rhsPenetration *= faster;
      // Pushed by a velocity, which stays: as if it was no deeper.
      if (const btScalar deeper = -point_of(row).getDistance() - most; deeper > 0 && row.m_rhsPenetration == 0)
        row.m_rhs -= deeper * info.m_erp2 / info.m_timeStep * row.m_jacDiagABInv;
    }
  }
  if (!any) return;
  // Bullet leaves out rows where this is 0.
  constexpr auto no_room = btScalar(1e-9);
  for (int k = 0; k < rows.size(); ++k)
    if (rows[k].m_rhsPenetration == 0)
      rows[k].m_rhsPenetration =
          -std::max(point_of(rows[k]).getDistance(), no_room) / info.m_timeStep * rows[k].m_jacDiagABInv;
}

template <class Solver>
void Counted<Solver>::convert(btPersistentManifold& manifold, const btContactSolverInfo& info) {
  btPersistentManifold* one = &manifold;
  if (conveyors_.empty())
    Solver::convertContacts(&one, 1, info);
  else
    convert_with_conveyor(manifold, info);
}

/// Whether any contact of two objects has friction: both have some.
bool can_rub(const btPersistentManifold& manifold) {
  for (int k = 0; k < manifold.getNumContacts(); ++k)
    if (manifold.getContactPoint(k).m_combinedFriction > 0) return true;
  return false;
}

// The solver's body of a conveyor has its velocity only while rows of one manifold are made: they take what they need
// of it along. That is for rows of friction. Rows of contacts must not push along their normals, of which a manifold
// can have several, so what they took is taken back.
template <class Solver>
void Counted<Solver>::convert_with_conveyor(btPersistentManifold& manifold, const btContactSolverInfo& info) {
  btPersistentManifold* one = &manifold;
  const int first = this->m_tmpSolverContactConstraintPool.size();
  // Both of Bullet's const accessors give objects that its own solver changes as well.
  const std::array<btCollisionObject*, 2> sides{const_cast<btCollisionObject*>(manifold.getBody0()),
                                                const_cast<btCollisionObject*>(manifold.getBody1())};
  const auto velocity_of = [&](std::size_t side) -> btVector3& {
    return this->m_tmpSolverBodyPool[this->getOrInitSolverBody(*sides[side], info.m_timeStep)].m_linearVelocity;
  };
  std::array<btVector3, 2> surface;
  const bool rubs = can_rub(manifold);
  for (std::size_t side = 0; side < 2; ++side) {
    const btVector3* const velocity = rubs ? surface_velocity(conveyors_, *sides[side]) : nullptr;
    surface[side] = velocity != nullptr ? *velocity : btVector3(0, 0, 0);
    if (velocity != nullptr) velocity_of(side) = *velocity;
  }
  Solver::convertContacts(&one, 1, info);
  if (surface[0].isZero() && surface[1].isZero()) return;
  for (int i = first; i < this->m_tmpSolverContactConstraintPool.size(); ++i) {
    btSolverConstraint& row = this->m_tmpSolverContactConstraintPool[i];
    const btScalar closing = row.m_contactNormal1.dot(surface[0]) + row.m_contactNormal2.dot(surface[1]);
    row.m_rhs += closing * row.m_jacDiagABInv;
    ++rows_.carried;
  }
  for (std::size_t side = 0; side < 2; ++side)
    if (!surface[side].isZero()) velocity_of(side).setZero();
}

template <class Solver>
void Counted<Solver>::count_acting_rows(const btContactSolverInfo& info) {
  const auto faint = btScalar(1e-20);
  const btConstraintArray &contacts = this->m_tmpSolverContactConstraintPool,
                          &rolling = this->m_tmpSolverContactRollingFrictionConstraintPool,
                          &joints = this->m_tmpSolverNonContactConstraintPool;
  for (int i = 0; i < rolling.size(); ++i) {
    const btSolverConstraint& row = rolling[i];
    if (row.m_appliedImpulse == 0 || row.m_friction < faint) continue;
    // Rows of spinning turn about the normal of their contact.
    const btScalar cosine = row.m_relpos1CrossNormal.dot(contacts[row.m_frictionIndex].m_contactNormal1);
    ++(btFabs(cosine) > btScalar(0.9) ? rows_.acting_spinning : rows_.acting_rolling);
  }
  for (int i = 0; i < joints.size(); ++i) {
    const btSolverConstraint& row = joints[i];
    if (row.m_appliedImpulse == 0) continue;
    ++rows_.acting_joint;
    if (row.m_lowerLimit == 0 || row.m_upperLimit == 0)
      ++rows_.acting_limit;
    else if (row.m_upperLimit <
             static_cast<btTypedConstraint*>(row.m_originalContactPoint)->getBreakingImpulseThreshold())
      ++rows_.acting_motor;
  }
  if (info.m_splitImpulse == 0) return;
  for (int i = 0; i < contacts.size(); ++i) rows_.pushed_apart += contacts[i].m_appliedPushImpulse != 0;
}

template <class Solver>
btScalar Counted<Solver>::solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                                            btPersistentManifold** manifolds, int manifold_count,
                                                            btTypedConstraint** joints, int joint_count,
                                                            const btContactSolverInfo& info, btIDebugDraw* drawer) {
  const auto size = [](const btConstraintArray& pool) { return static_cast<std::uint64_t>(pool.size()); };
  rows_.contact += size(this->m_tmpSolverContactConstraintPool);
  rows_.friction += size(this->m_tmpSolverContactFrictionConstraintPool);
  rows_.rolling += size(this->m_tmpSolverContactRollingFrictionConstraintPool);
  rows_.joint += size(this->m_tmpSolverNonContactConstraintPool);
  if constexpr (has_multibodies) this->count_all(rows_);
  const btScalar result = Solver::solveGroupCacheFriendlyIterations(bodies, body_count, manifolds, manifold_count,
                                                                    joints, joint_count, info, drawer);
  count_acting_rows(info);
  if constexpr (has_multibodies) {
    this->count_acting(rows_);
    if (acting_on_ != nullptr) work_.surfaces += this->work_of_surfaces();
  }
  if (acting_on_ != nullptr)
    add_work({this->m_tmpSolverBodyPool, this->m_tmpSolverContactConstraintPool,
              this->m_tmpSolverContactFrictionConstraintPool, this->m_tmpSolverContactRollingFrictionConstraintPool,
              this->m_tmpSolverNonContactConstraintPool},
             conveyors_, info, *acting_on_, work_);
  residual_ = std::max(residual_, static_cast<double>(this->m_leastSquaresResidual));
  if constexpr (std::is_same_v<Solver, MlcpSolver>) {
    rows_.other = this->solved_rows();
    rows_.handed_back = this->handed_back();
  } else if constexpr (!has_multibodies && !std::is_same_v<Solver, SequentialImpulses>) {
    rows_.other = rows_.contact + rows_.friction + rows_.rolling + rows_.joint;
  }
  return result;
}

}  // namespace

double RowSolver::take_residual() {
  return std::exchange(residual_, 0);
}

std::unique_ptr<RowSolver> make_row_solver(SolverKind kind, bool friction) {
  switch (kind) {
    case SolverKind::sequential_impulses:
      break;
    case SolverKind::nncg:
      return std::make_unique<Counted<ConjugateGradients>>(friction);
    case SolverKind::dantzig:
    case SolverKind::lemke:
    case SolverKind::projected_gauss_seidel:
      return std::make_unique<Counted<MlcpSolver>>(friction, kind);
    case SolverKind::multibodies:
      return std::make_unique<Counted<MultibodySolver>>(friction);
  }
  return std::make_unique<Counted<SequentialImpulses>>(friction);
}

}  // namespace boxstream::scenes
