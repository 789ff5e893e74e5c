// SPDX-License-Identifier: MIT
#include "simulation/engine/row_solver.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>

namespace boxstream::scenes {

void RowSolver::convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) {
  if (info.m_splitImpulse != 0) {
    move_apart(manifolds, count, info);
  } else if (!conveyors_.empty()) {
    for (int i = 0; i < count; ++i) convert(*manifolds[i], info);
  } else {
    btSequentialImpulseConstraintSolver::convertContacts(manifolds, count, info);
  }
  // Afterwards Bullet copies impulses back from the places where these rows were: the memory is still theirs, and what
  // it copies is read by rows of friction alone.
  if (!friction_) m_tmpSolverContactFrictionConstraintPool.resizeNoInitialize(0);
}

static const btManifoldPoint& point_of(const btSolverConstraint& row) {
  return *static_cast<const btManifoldPoint*>(row.m_originalContactPoint);
}

// Bullet moves bodies apart as if those contacts were alone that are to be moved, and pushes what lies on a floor
// through it. Here the others hold: nothing is moved further than they have room.
void RowSolver::move_apart(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) {
  btConstraintArray& rows = m_tmpSolverContactConstraintPool;
  btContactSolverInfo of_one = info;  // each has a bound of its own
  bool any = false;
  for (int i = 0; i < count; ++i) {
    of_one.m_splitImpulsePenetrationThreshold = moved_apart_.threshold(*manifolds[i]);
    const int first = rows.size();
    convert(*manifolds[i], of_one);
    for (int k = first; k < rows.size(); ++k) {
      if (rows[k].m_rhsPenetration == 0) continue;
      rows[k].m_rhsPenetration *= moved_apart_.mended(*manifolds[i], -point_of(rows[k]).getDistance());
      any = true;
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

void RowSolver::convert(btPersistentManifold& manifold, const btContactSolverInfo& info) {
  btPersistentManifold* one = &manifold;
  if (conveyors_.empty())
    btSequentialImpulseConstraintSolver::convertContacts(&one, 1, info);
  else
    convert_with_conveyor(manifold, info);
}

const btVector3* RowSolver::surface_velocity(const btCollisionObject& body) const {
  const auto found = conveyors_.find(&body);
  return found == conveyors_.end() ? nullptr : &found->second;
}

/// Whether any contact of two objects has friction: both have some.
static bool can_rub(const btPersistentManifold& manifold) {
  for (int k = 0; k < manifold.getNumContacts(); ++k)
    if (manifold.getContactPoint(k).m_combinedFriction > 0) return true;
  return false;
}

// The solver's body of a conveyor has its velocity only while rows of one manifold are made: they take what they need
// of it along. That is for rows of friction. Rows of contacts must not push along their normals, of which a manifold
// can have several, so what they took is taken back.
void RowSolver::convert_with_conveyor(btPersistentManifold& manifold, const btContactSolverInfo& info) {
  btPersistentManifold* one = &manifold;
  const int first = m_tmpSolverContactConstraintPool.size();
  // Both of Bullet's const accessors give objects that its own solver changes as well.
  const std::array<btCollisionObject*, 2> sides{const_cast<btCollisionObject*>(manifold.getBody0()),
                                                const_cast<btCollisionObject*>(manifold.getBody1())};
  const auto velocity_of = [&](std::size_t side) -> btVector3& {
    return m_tmpSolverBodyPool[getOrInitSolverBody(*sides[side], info.m_timeStep)].m_linearVelocity;
  };
  std::array<btVector3, 2> surface;
  const bool rubs = can_rub(manifold);
  for (std::size_t side = 0; side < 2; ++side) {
    const btVector3* const velocity = rubs ? surface_velocity(*sides[side]) : nullptr;
    surface[side] = velocity != nullptr ? *velocity : btVector3(0, 0, 0);
    if (velocity != nullptr) velocity_of(side) = *velocity;
  }
  btSequentialImpulseConstraintSolver::convertContacts(&one, 1, info);
  if (surface[0].isZero() && surface[1].isZero()) return;
  for (int i = first; i < m_tmpSolverContactConstraintPool.size(); ++i) {
    btSolverConstraint& row = m_tmpSolverContactConstraintPool[i];
    const btScalar closing = row.m_contactNormal1.dot(surface[0]) + row.m_contactNormal2.dot(surface[1]);
    row.m_rhs += closing * row.m_jacDiagABInv;
    ++rows_.carried;
  }
  for (std::size_t side = 0; side < 2; ++side)
    if (!surface[side].isZero()) velocity_of(side).setZero();
}

void RowSolver::count_acting_rows(const btContactSolverInfo& info) {
  const auto faint = btScalar(1e-20);
  const btConstraintArray &contacts = m_tmpSolverContactConstraintPool,
                          &rolling = m_tmpSolverContactRollingFrictionConstraintPool,
                          &joints = m_tmpSolverNonContactConstraintPool;
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

/// Work that a row's impulse takes from a kinematic body, which goes on as before: joules. `surface` is how fast its
/// surface moves in addition.
static double given_by(const btSolverBody& body, const btVector3& normal, const btVector3& arm, double impulse,
                       const btVector3* surface) {
  const btRigidBody* const original = body.m_originalBody;
  if (original == nullptr || !original->isKinematicObject()) return 0;
  btScalar speed = normal.dot(body.m_linearVelocity) + arm.dot(body.m_angularVelocity);
  if (surface != nullptr) speed += normal.dot(*surface);
  return -impulse * double{speed};
}

/// Whether a row is that of a motor. Springs are rows of bounded strength, too, but keep the energy that they take.
static bool is_motor(const btSolverConstraint& row) {
  const auto& joint = *static_cast<const btTypedConstraint*>(row.m_originalContactPoint);
  return row.m_lowerLimit < 0 && row.m_upperLimit > 0 && joint.getConstraintType() != D6_SPRING_2_CONSTRAINT_TYPE &&
         row.m_upperLimit < joint.getBreakingImpulseThreshold();
}

// An impulse does the work of its size times the mean of the velocities before and after, along its row.
void RowSolver::add_work(const btContactSolverInfo& info) {
  const auto mean_speed = [&](const btSolverConstraint& row) {
    const auto of = [](const btSolverBody& body, const btVector3& normal, const btVector3& arm) {
      if (body.m_originalBody == nullptr) return btScalar(0);
      return normal.dot(body.m_linearVelocity + (body.m_externalForceImpulse + body.m_deltaLinearVelocity) / 2) +
             arm.dot(body.m_angularVelocity + (body.m_externalTorqueImpulse + body.m_deltaAngularVelocity) / 2);
    };
    return of(m_tmpSolverBodyPool[row.m_solverBodyIdA], row.m_contactNormal1, row.m_relpos1CrossNormal) +
           of(m_tmpSolverBodyPool[row.m_solverBodyIdB], row.m_contactNormal2, row.m_relpos2CrossNormal);
  };
  const auto of_surfaces = [&](const btConstraintArray& rows, bool rubbing) {
    for (int i = 0; i < rows.size(); ++i) {
      const btSolverConstraint& row = rows[i];
      if (row.m_appliedImpulse == 0) continue;
      const auto of = [&](int id, const btVector3& normal, const btVector3& arm) {
        const btSolverBody& body = m_tmpSolverBodyPool[id];
        const btVector3* const surface =
            rubbing && body.m_originalBody != nullptr ? surface_velocity(*body.m_originalBody) : nullptr;
        return given_by(body, normal, arm, double{row.m_appliedImpulse}, surface);
      };
      work_.surfaces += of(row.m_solverBodyIdA, row.m_contactNormal1, row.m_relpos1CrossNormal) +
                        of(row.m_solverBodyIdB, row.m_contactNormal2, row.m_relpos2CrossNormal);
    }
  };
  bool any_kinematic = false;
  for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i) {
    const btSolverBody& body = m_tmpSolverBodyPool[i];
    if (body.m_originalBody == nullptr) continue;
    any_kinematic = any_kinematic || body.m_originalBody->isKinematicObject();
    if (info.m_splitImpulse == 0 || body.m_invMass.x() == 0) continue;
    for (int axis = 0; axis < 3; ++axis)
      work_.apart[axis] += double{body.m_pushVelocity[axis]} * info.m_timeStep / body.m_invMass[axis];
  }
  for (int i = 0; i < m_tmpSolverNonContactConstraintPool.size(); ++i) {
    const btSolverConstraint& row = m_tmpSolverNonContactConstraintPool[i];
    if (row.m_appliedImpulse != 0 && is_motor(row)) work_.motors += double{row.m_appliedImpulse} * mean_speed(row);
  }
  if (!any_kinematic) return;
  of_surfaces(m_tmpSolverContactConstraintPool, false);
  of_surfaces(m_tmpSolverContactFrictionConstraintPool, true);
  of_surfaces(m_tmpSolverContactRollingFrictionConstraintPool, false);
  of_surfaces(m_tmpSolverNonContactConstraintPool, false);
}

btScalar RowSolver::solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                                      btPersistentManifold** manifolds, int manifold_count,
                                                      btTypedConstraint** joints, int joint_count,
                                                      const btContactSolverInfo& info, btIDebugDraw* drawer) {
  const auto size = [](const btConstraintArray& pool) { return static_cast<std::uint64_t>(pool.size()); };
  rows_.contact += size(m_tmpSolverContactConstraintPool);
  rows_.friction += size(m_tmpSolverContactFrictionConstraintPool);
  rows_.rolling += size(m_tmpSolverContactRollingFrictionConstraintPool);
  rows_.joint += size(m_tmpSolverNonContactConstraintPool);
  const btScalar result = btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyIterations(
      bodies, body_count, manifolds, manifold_count, joints, joint_count, info, drawer);
  count_acting_rows(info);
  if (counts_work_) add_work(info);
  residual_ = std::max(residual_, static_cast<double>(m_leastSquaresResidual));
  return result;
}

double RowSolver::take_residual() {
  return std::exchange(residual_, 0);
}

}  // namespace boxstream::scenes
