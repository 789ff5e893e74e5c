// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <unordered_map>

#include <BulletDynamics/ConstraintSolver/btContactSolverInfo.h>
#include <BulletDynamics/ConstraintSolver/btSolverBody.h>
#include <BulletDynamics/ConstraintSolver/btSolverConstraint.h>

class btCollisionObject;
class btRigidBody;

namespace boxstream::scenes {

/// How fast the surfaces of fixed and kinematic bodies move along what touches them, in m/s along the world's axes.
using Conveyors = std::unordered_map<const btCollisionObject*, btVector3>;

/// Null if a body is no conveyor.
const btVector3* surface_velocity(const Conveyors& conveyors, const btCollisionObject& body);

/// What a solver did beside taking energy out, summed over all islands and steps.
struct SolverWork {
  double motors = 0;            ///< joules, of motors of joints
  double surfaces = 0;          ///< joules, of kinematic bodies and conveyors
  double apart[3] = {0, 0, 0};  ///< kg m: masses times the ways by which split impulses moved them
};

/// The rows of an island that was solved, and the bodies that they push.
struct SolvedRows {
  const btAlignedObjectArray<btSolverBody>& bodies;
  const btConstraintArray &contacts, &friction, &rolling, &joints;
};

/// To be called before the velocities are given to the bodies: `acting_on`, for each that a row pushes.
void add_work(const SolvedRows& rows, const Conveyors& conveyors, const btContactSolverInfo& info,
              const std::function<void(const btRigidBody&)>& acting_on, SolverWork& work);

}  // namespace boxstream::scenes
