// SPDX-License-Identifier: MIT
// Clauses P9 and P10 of the contract: ghost objects and the kinematic character controller.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>
#include <btBulletDynamicsCommon.h>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

TEST(BulletContract, P9_GhostPairsAreEager) {
  struct Case {
    Kind kind;
    bool eager;
  };
  for (const Case c : {Case{Kind::dbvt, true},
                       {Kind::axis32, true},
                       {Kind::dbvt_deferred, false},
                       {Kind::simple, false},
                       {Kind::subject, true}}) {
    Rig rig(c.kind);
    btGhostPairCallback ghost_callback;
    rig.cache().setInternalGhostPairCallback(&ghost_callback);
    btCollisionObject box;
    btPairCachingGhostObject ghost, other_ghost;
    btBroadphaseProxy* at_box = rig.create_for(&box, cube(0, 0, 0));
    btBroadphaseProxy* at_other = rig.create_for(&other_ghost, cube(60, 0, 0));
    btBroadphaseProxy* at_ghost = rig.create_for(&ghost, cube(20, 0, 0));
    rig.calculate();
    rig.move(at_ghost, cube(0, btScalar(0.3), 0));  // setAabb alone
    EXPECT_EQ(ghost.getNumOverlappingObjects(), c.eager ? 1 : 0) << c.kind;
    EXPECT_EQ(ghost.getOverlappingPairCache()->getNumOverlappingPairs(), c.eager ? 1 : 0) << c.kind;
    rig.calculate();
    EXPECT_EQ(ghost.getNumOverlappingObjects(), 1) << c.kind;
    EXPECT_TRUE(rig.holds(at_box, at_ghost)) << c.kind;
    rig.move(at_ghost, cube(60, 0, 0));  // two ghosts
    rig.calculate();
    EXPECT_TRUE(rig.holds(at_other, at_ghost)) << c.kind;
    EXPECT_EQ(other_ghost.getNumOverlappingObjects(), 1) << c.kind;
    EXPECT_FALSE(rig.holds(at_box, at_ghost)) << c.kind;
    EXPECT_EQ(ghost.getNumOverlappingObjects(), 1) << c.kind;
    for (btBroadphaseProxy* proxy : {at_box, at_other, at_ghost}) rig.destroy(proxy);
    EXPECT_EQ(ghost.getNumOverlappingObjects(), 0) << c.kind;
    EXPECT_EQ(other_ghost.getNumOverlappingObjects(), 0) << c.kind;
    rig.cache().setInternalGhostPairCallback(nullptr);
  }
}

void ghosts_are_eager_with(btOverlappingPairCache* cache) {
  Rig rig(Kind::subject, cache);
  btGhostPairCallback ghost_callback;
  rig.cache().setInternalGhostPairCallback(&ghost_callback);
  btCollisionObject box;
  btPairCachingGhostObject ghost;
  btBroadphaseProxy* at_box = rig.create_for(&box, cube(0, 0, 0));
  btBroadphaseProxy* at_ghost = rig.create_for(&ghost, cube(0, btScalar(0.5), 0));  // by createProxy
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 1);
  rig.calculate();
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 1);
  rig.move(at_ghost, cube(20, 0, 0));
  rig.calculate();
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 0);
  for (int i = 0; i < 5; ++i) {  // the loop of recoverFromPenetration: no event is repeated
    rig.move(at_ghost, cube(0, btScalar(i) / 10, 0));
    EXPECT_EQ(ghost.getNumOverlappingObjects(), 1);
    EXPECT_EQ(rig.pair_count(), 1);
  }
  rig.destroy(at_box);
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 0);
  rig.destroy(at_ghost);
  rig.cache().setInternalGhostPairCallback(nullptr);
}

TEST(BulletContract, P9_GhostPairsAreEagerOnCreation) {
  ghosts_are_eager_with(nullptr);
}

TEST(BulletContract, P9_GhostPairsAreEagerInAnExternalCache) {
  btHashedOverlappingPairCache cache;
  ghosts_are_eager_with(&cache);
}

TEST(BulletContract, P9_CharacterRecoversFromPenetrationWithoutAStep) {
  for (const Kind kind : {Kind::dbvt, Kind::simple, Kind::subject}) {
    Rig rig(kind);
    btGhostPairCallback ghost_callback;
    rig.cache().setInternalGhostPairCallback(&ghost_callback);
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&rig.dispatcher, rig.broadphase.get(), &solver, &rig.config);
    btBoxShape block(btVector3(2, 2, 2));
    btCollisionObject wall;
    wall.setCollisionShape(&block);
    world.addCollisionObject(&wall, btBroadphaseProxy::StaticFilter, btBroadphaseProxy::AllFilter);
    btCapsuleShape capsule(btScalar(0.4), 1);
    btPairCachingGhostObject ghost;
    ghost.setCollisionShape(&capsule);
    ghost.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
    ghost.getWorldTransform().setOrigin(btVector3(20, 0, 0));
    world.addCollisionObject(&ghost, btBroadphaseProxy::CharacterFilter, btBroadphaseProxy::AllFilter);
    world.performDiscreteCollisionDetection();
    btKinematicCharacterController controller(&ghost, &capsule, btScalar(0.3), btVector3(0, 1, 0));
    ghost.getWorldTransform().setOrigin(btVector3(2, 0, 0));  // 0.4 deep in the wall; up to 0.2 is left alone
    controller.setGravity(btVector3(0, 0, 0));
    controller.preStep(&world);
    controller.playerStep(&world, btScalar(1) / 60);  // setAabb, then dispatch of the ghost's own pairs; no calculate
    const btScalar x = ghost.getWorldTransform().getOrigin().x();
    if (kind == Kind::simple) {
      EXPECT_EQ(x, 2);
    } else {
      EXPECT_GT(x, btScalar(2.05)) << kind;
    }
    world.removeCollisionObject(&ghost);
    world.removeCollisionObject(&wall);
    EXPECT_EQ(ghost.getNumOverlappingObjects(), 0) << kind;
    rig.cache().setInternalGhostPairCallback(nullptr);
  }
}

TEST(BulletContract, P10_NoRedundantGhostEvents) {
  Rig rig;
  GhostLog log;
  rig.cache().setInternalGhostPairCallback(&log);
  btPairCachingGhostObject ghost;
  std::vector<btBroadphaseProxy*> heap = make_heap(rig, 200, 10, 3);
  btBroadphaseProxy* at_ghost = rig.create_for(&ghost, cube(0, 0, 0, 2));
  Random random(10);
  for (int frame = 0; frame < 60; ++frame) {
    for (int i = 0; i < 20; ++i) {
      const btVector3 p = random.vector(-3, 3);
      rig.move(heap[static_cast<std::size_t>(random.below(200))], cube(p.x(), p.y(), p.z()));
    }
    for (int i = 0; i < 3; ++i) rig.move(at_ghost, cube(random.real(-1, 1), 0, 0, 2));
    rig.calculate();
    ASSERT_EQ(log.standing(), sorted(rig.pairs())) << "frame " << frame;  // fails on a repeated add or remove
    log.events.clear();
    for (const auto& [a, b] : rig.pairs()) log.events.push_back({true, a, b, nullptr, nullptr});
  }
  rig.cache().setInternalGhostPairCallback(nullptr);
}

}  // namespace
}  // namespace boxstream::bullet_test
