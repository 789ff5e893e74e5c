// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {

/// A real dynamics world on one of the broad-phases, watched by an oracle. Owns everything in it.
///
/// After each calculateOverlappingPairs it checks pairs and ghost lists against the oracle: equality for broad-phases
/// that are exact, equality after a re-test of the boxes for the others. When it is taken apart it checks that no pair,
/// ghost event, algorithm or manifold is left.
class TestWorld {
 public:
  /// Broad-phases in Bullet's tree that are not exact hold more pairs than they should.
  static Rule rule_of(Kind kind) {
    return kind == Kind::subject || kind == Kind::simple ? Rule::exact : Rule::superset;
  }

  explicit TestWorld(Kind kind, btOverlappingPairCache* cache = nullptr);
  ~TestWorld();
  TestWorld(const TestWorld&) = delete;
  TestWorld& operator=(const TestWorld&) = delete;

  /// Steps of 1/60 s without interpolation; stops at the first step that failed.
  void run(int steps);
  /// Removes and deletes everything, as P5 has it: object by object, with no calculate in between.
  void clear();

  template <class Shape, class... Args>
  Shape* shape(Args&&... args) {
    auto made = std::make_unique<Shape>(std::forward<Args>(args)...);
    Shape* raw = made.get();
    shapes_.push_back(std::move(made));
    return raw;
  }
  btRigidBody* body(btScalar mass, btCollisionShape* shape, const btVector3& at,
                    const btQuaternion& turned = btQuaternion::getIdentity());
  btCollisionObject* object(btCollisionShape* shape, const btTransform& at);
  btPairCachingGhostObject* ghost(btCollisionShape* shape, const btVector3& at);
  btKinematicCharacterController* character(const btVector3& at);
  btSoftBody* soft(btSoftBody* body);
  void hinge(btRigidBody* a, btRigidBody* b, const btVector3& pivot_in_a, const btVector3& pivot_in_b);
  void ground();

  /// FNV-1a over the bits of all transforms and velocities.
  std::uint64_t state_hash() const;

  Kind kind;
  btSoftBodyRigidBodyCollisionConfiguration config;
  CountingDispatcher dispatcher{&config};
  Oracle* oracle;  // the same as `broadphase`
  std::unique_ptr<btBroadphaseInterface> broadphase;
  btSequentialImpulseConstraintSolver solver;
  std::unique_ptr<btSoftRigidDynamicsWorld> world;
  GhostLog ghost_log;
  std::vector<btRigidBody*> bodies;
  std::vector<btPairCachingGhostObject*> ghosts;
  long pairs_seen = 0;
  long contacts_seen = 0;

 private:
  void check_now();

  std::unique_ptr<btGhostPairCallback> forward_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btTypedConstraint>> constraints_;
  std::vector<std::unique_ptr<btKinematicCharacterController>> characters_;
};

}  // namespace boxstream::bullet_test
