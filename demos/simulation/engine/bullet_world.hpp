// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <btBulletDynamicsCommon.h>

#include "simulation/engine/contacts/sliding_contacts.hpp"
#include "simulation/engine/contacts/unit_contacts.hpp"
#include "simulation/engine/row_solver.hpp"
#include "simulation/engine/staged_world.hpp"
#include "simulation/engine/world_recipe.hpp"

class btSoftRigidDynamicsWorld;

namespace boxstream::scenes {

class MultibodyWorld;

/// An empty Bullet world on a given broad-phase, with all that Bullet needs around it, in the order of destruction that
/// Bullet needs.
class BulletWorld {
 public:
  BulletWorld(const WorldRecipe& recipe, std::unique_ptr<btBroadphaseInterface> broadphase);

  btDiscreteDynamicsWorld& world() { return *world_; }
  /// Null unless the recipe asks for soft bodies.
  btSoftRigidDynamicsWorld* soft_world() { return soft_world_; }
  /// Null unless the recipe asks for multibodies, and for no soft bodies.
  MultibodyWorld* multibody_world() { return multibody_world_; }
  btBroadphaseInterface& broadphase() { return *broadphase_; }
  btDispatcher& dispatcher() { return *dispatcher_; }
  RowSolver& solver() { return *solver_; }

  /// Of rigid and of soft bodies, in m/s^2.
  void set_gravity(const btVector3& gravity);

  /// Ends all pairs through the pair cache, ghosts and algorithms included. To be called before taking out everything:
  /// removing thousands of objects one by one costs Bullet's own broad-phases a scan of all pairs for each.
  void end_all_pairs();

  /// Called at the end of each computeOverlappingPairs. Must not throw.
  std::function<void()> after_pairs;

  MotionHooks hooks;

  std::uint64_t swept_hits = 0;  ///< what sweeps of fast bodies hit, before the solver or after it, in all steps

 private:
  std::unique_ptr<btDefaultCollisionConfiguration> configuration_;
  std::unique_ptr<btCollisionDispatcher> dispatcher_;
  std::unique_ptr<SlidingContacts> sliding_contacts_;
  std::unique_ptr<UnitContacts> unit_contacts_;
  std::unique_ptr<btGhostPairCallback> ghost_callback_;
  std::unique_ptr<btBroadphaseInterface> broadphase_;
  std::unique_ptr<RowSolver> solver_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
  btSoftRigidDynamicsWorld* soft_world_ = nullptr;
  MultibodyWorld* multibody_world_ = nullptr;
};

}  // namespace boxstream::scenes
