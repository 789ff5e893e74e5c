// SPDX-License-Identifier: MIT
#include "simulation/engine/solver_work.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace boxstream::scenes {
namespace {

/// Work that a row's impulse takes from a kinematic body, which goes on as before: joules. `surface` is how fast its
/// surface moves in addition.
double given_by(const btSolverBody& body, const btVector3& normal, const btVector3& arm, double impulse,
                const btVector3* surface) {
  const btRigidBody* const original = body.m_originalBody;
  if (original == nullptr || !original->isKinematicObject()) return 0;
  btScalar speed = normal.dot(body.m_linearVelocity) + arm.dot(body.m_angularVelocity);
  if (surface != nullptr) speed += normal.dot(*surface);
  return -impulse * double{speed};
}

/// Whether a row is that of a motor. Springs are rows of bounded strength, too, but keep the energy that they take.
bool is_motor(const btSolverConstraint& row) {
  const auto& joint = *static_cast<const btTypedConstraint*>(row.m_originalContactPoint);
  return row.m_lowerLimit < 0 && row.m_upperLimit > 0 && joint.getConstraintType() != D6_SPRING_2_CONSTRAINT_TYPE &&
         row.m_upperLimit < joint.getBreakingImpulseThreshold();
}

/// Whether no bit is set. Most bodies of most steps fly free, and are told by this alone.
bool is_nothing(const btVector3& change) {
  std::uint64_t all = 0;
  for (const std::uint64_t part : std::bit_cast<std::array<std::uint64_t, sizeof(btVector3) / 8>>(change)) all |= part;
  return all == 0;
}

/// Visits once each body that a row can push: all, if it would take as long to find out which those are.
template <class Visit>
void for_each_in_reach(const SolvedRows& rows, Visit visit) {
  if (rows.contacts.size() + rows.joints.size() > rows.bodies.size()) {
    for (int i = 0; i < rows.bodies.size(); ++i) visit(rows.bodies[i]);
    return;
  }
  std::vector<char> is_visited(static_cast<std::size_t>(rows.bodies.size()));
  const auto visit_once = [&](int id) {
    if (std::exchange(is_visited[static_cast<std::size_t>(id)], 1) == 0) visit(rows.bodies[id]);
  };
  for (const btConstraintArray* const pool : {&rows.contacts, &rows.joints})
    for (int i = 0; i < pool->size(); ++i) {
      visit_once((*pool)[i].m_solverBodyIdA);
      visit_once((*pool)[i].m_solverBodyIdB);
    }
}

}  // namespace

const btVector3* surface_velocity(const Conveyors& conveyors, const btCollisionObject& body) {
  const auto found = conveyors.find(&body);
  return found == conveyors.end() ? nullptr : &found->second;
}

// An impulse does the work of its size times the mean of the velocities before and after, along its row.
void add_work(const SolvedRows& rows, const Conveyors& conveyors, const btContactSolverInfo& info,
              const std::function<void(const btRigidBody&)>& acting_on, SolverWork& work) {
  // Bodies that fly free are among those of the solver.
  if (rows.contacts.size() == 0 && rows.joints.size() == 0) return;
  const auto mean_speed = [&](const btSolverConstraint& row) {
    const auto of = [](const btSolverBody& body, const btVector3& normal, const btVector3& arm) {
      if (body.m_originalBody == nullptr) return btScalar(0);
      return normal.dot(body.m_linearVelocity + (body.m_externalForceImpulse + body.m_deltaLinearVelocity) / 2) +
             arm.dot(body.m_angularVelocity + (body.m_externalTorqueImpulse + body.m_deltaAngularVelocity) / 2);
    };
    return of(rows.bodies[row.m_solverBodyIdA], row.m_contactNormal1, row.m_relpos1CrossNormal) +
           of(rows.bodies[row.m_solverBodyIdB], row.m_contactNormal2, row.m_relpos2CrossNormal);
  };
  const auto of_surfaces = [&](const btConstraintArray& pushing, bool rubbing) {
    for (int i = 0; i < pushing.size(); ++i) {
      const btSolverConstraint& row = pushing[i];
      if (row.m_appliedImpulse == 0) continue;
      const auto of = [&](int id, const btVector3& normal, const btVector3& arm) {
        const btSolverBody& body = rows.bodies[id];
        const btVector3* const surface =
            rubbing && body.m_originalBody != nullptr ? surface_velocity(conveyors, *body.m_originalBody) : nullptr;
        return given_by(body, normal, arm, double{row.m_appliedImpulse}, surface);
      };
      work.surfaces += of(row.m_solverBodyIdA, row.m_contactNormal1, row.m_relpos1CrossNormal) +
                       of(row.m_solverBodyIdB, row.m_contactNormal2, row.m_relpos2CrossNormal);
    }
  };
  const bool splits = info.m_splitImpulse != 0;
  bool any_kinematic = false;
  for_each_in_reach(rows, [&](const btSolverBody& body) {
    if (body.m_originalBody == nullptr) return;
    const bool is_movable = body.m_invMass.x() != 0, is_moved = splits && !is_nothing(body.m_pushVelocity);
    if (is_movable && !is_moved && is_nothing(body.m_deltaLinearVelocity) && is_nothing(body.m_deltaAngularVelocity) &&
        !(splits && !is_nothing(body.m_turnVelocity)))
      return;
    any_kinematic = any_kinematic || body.m_originalBody->isKinematicObject();
    if (!is_movable) return;
    if (is_moved)
      for (int axis = 0; axis < 3; ++axis)
        work.apart[axis] += double{body.m_pushVelocity[axis]} * info.m_timeStep / body.m_invMass[axis];
    acting_on(*body.m_originalBody);
  });
  for (int i = 0; i < rows.joints.size(); ++i) {
    const btSolverConstraint& row = rows.joints[i];
    if (row.m_appliedImpulse != 0 && is_motor(row)) work.motors += double{row.m_appliedImpulse} * mean_speed(row);
  }
  if (!any_kinematic) return;
  of_surfaces(rows.contacts, false);
  of_surfaces(rows.friction, true);
  of_surfaces(rows.rolling, false);
  of_surfaces(rows.joints, false);
}

}  // namespace boxstream::scenes
