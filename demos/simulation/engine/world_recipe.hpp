// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/ConstraintSolver/btContactSolverInfo.h>
#include <LinearMath/btScalar.h>
#include <LinearMath/btVector3.h>

#include "formats/scene_model/settings.hpp"

namespace boxstream::scenes {

/// That of the Bullet in this program. There is one in each: both have the same names.
inline constexpr Precision precision_here = sizeof(btScalar) == sizeof(double) ? Precision::doubled : Precision::single;

/// What a Bullet world is made with. As it stands here, the world integrates velocities and does nothing else: every
/// effect that a scene calls for adds its part. Stages of Bullet's step that are off are skipped, not run on nothing.
struct WorldRecipe {
  WorldRecipe() {
    solver.m_splitImpulse = 0;
    solver.m_solverMode = SOLVER_SIMD;
  }

  bool soft = false;         ///< btSoftRigidDynamicsWorld and its collision configuration
  bool ghost_pairs = false;  ///< btGhostPairCallback in the pair cache
  bool collide = false;      ///< updateAabbs, calculateOverlappingPairs and dispatch
  bool friction = false;     ///< rows of the solver for sliding friction, and contacts that go along with what slides
  bool apply_gravity = false;
  bool apply_damping = false;
  bool deactivate = false;   ///< bodies at rest fall asleep
  bool continuous = false;   ///< boxes cover the motion of a step, and bodies with a threshold are swept
  bool force_boxes = false;  ///< boxes of sleeping bodies are set again in each step
  bool move_kinematic = false;
  bool unit_contacts = false;  ///< contacts of bodies that are marked are found in units of their own size
  SolverKind solver_kind = SolverKind::sequential_impulses;
  int threads = 1;  ///< of the search for pairs
  btVector3 gravity{0, 0, 0};
  btContactSolverInfo solver;
};

}  // namespace boxstream::scenes
