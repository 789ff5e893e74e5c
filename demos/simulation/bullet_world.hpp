// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <btBulletDynamicsCommon.h>

class btSoftRigidDynamicsWorld;

namespace boxstream::scenes {

struct Scene;

/// An empty Bullet world on a given broad-phase, with all that Bullet needs around it, in the order of destruction that
/// Bullet needs. The class of the world is the plain one unless the scene has soft bodies.
class BulletWorld {
 public:
  BulletWorld(const Scene& scene, std::unique_ptr<btBroadphaseInterface> broadphase);

  btDiscreteDynamicsWorld& world() { return *world_; }
  /// Null unless the scene has soft bodies.
  btSoftRigidDynamicsWorld* soft_world() { return soft_world_; }
  btBroadphaseInterface& broadphase() { return *broadphase_; }
  btDispatcher& dispatcher() { return *dispatcher_; }

  /// Ends all pairs through the pair cache, ghosts and algorithms included. To be called before taking out everything:
  /// removing thousands of objects one by one costs Bullet's own broad-phases a scan of all pairs for each.
  void end_all_pairs();

  /// Called at the end of each computeOverlappingPairs. Must not throw.
  std::function<void()> after_pairs;

 private:
  std::unique_ptr<btDefaultCollisionConfiguration> configuration_;
  std::unique_ptr<btCollisionDispatcher> dispatcher_;
  std::unique_ptr<btGhostPairCallback> ghost_callback_;
  std::unique_ptr<btBroadphaseInterface> broadphase_;
  std::unique_ptr<btSequentialImpulseConstraintSolver> solver_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
  btSoftRigidDynamicsWorld* soft_world_ = nullptr;
};

}  // namespace boxstream::scenes
