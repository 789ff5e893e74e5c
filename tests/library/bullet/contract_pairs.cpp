// SPDX-License-Identifier: MIT
// Section 4 of the contract: how pairs begin, last, end, are filtered and ordered.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <map>
#include <set>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

TEST(BulletContract, P1_BirthOnClosedOverlap) {
  for (const Kind kind : {Kind::simple, Kind::dbvt, Kind::subject}) {
    Rig rig(kind);
    GhostLog ghost;
    rig.cache().setInternalGhostPairCallback(&ghost);
    btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
    btBroadphaseProxy* face = rig.create(cube(1, 0, 0));
    btBroadphaseProxy* edge = rig.create(cube(1, 1, 0));
    btBroadphaseProxy* corner = rig.create(cube(-1, -1, -1));
    btBroadphaseProxy* other = rig.create(cube(0, 0, 0), 2, 2);
    rig.calculate();
    EXPECT_TRUE(rig.holds(a, face)) << kind;
    EXPECT_TRUE(rig.holds(a, edge)) << kind;
    EXPECT_TRUE(rig.holds(a, corner)) << kind;
    EXPECT_FALSE(rig.holds(face, corner)) << kind;
    for (btBroadphaseProxy* proxy : {a, face, edge, corner}) EXPECT_TRUE(!rig.holds(other, proxy)) << kind;
    EXPECT_EQ(rig.pair_count(), 4) << kind;
    for (int i = 0; i < rig.pair_count(); ++i) {
      EXPECT_EQ(rig.cache().getOverlappingPairArray()[i].m_algorithm, nullptr) << kind;
      EXPECT_EQ(rig.cache().getOverlappingPairArray()[i].m_internalInfo1, nullptr) << kind;
    }
    EXPECT_EQ(ghost.standing(), sorted(rig.pairs())) << kind;
    rig.cache().setInternalGhostPairCallback(nullptr);
  }
}

struct Remembered {
  const btCollisionAlgorithm* algorithm;
  const btBroadphaseProxy* first;
  const void* info;
};

/// 1000 frames of motion; each pair gets an algorithm when it is first seen and must still have it while it lasts.
void run_thousand_frames(Rig& rig, Oracle& oracle) {
  Random random(1000);
  GhostLog ghost;
  rig.cache().setInternalGhostPairCallback(&ghost);
  const int n = 70;
  std::vector<btBroadphaseProxy*> proxies = make_heap(rig, n, 2, 2);
  std::vector<btVector3> at(n), velocity(n);
  for (std::size_t i = 0; i < n; ++i) {
    at[i] = random.vector(-2, 2);
    velocity[i] = random.vector(btScalar(-0.05), btScalar(0.05));
  }
  std::map<Oracle::SerialPair, Remembered> held;
  long begun = 0, ended = 0;
  std::vector<std::uintptr_t> infos(1 << 16);
  for (int frame = 0; frame < 1000; ++frame) {
    for (std::size_t i = 0; i < n; ++i) {
      if (frame % 50 > 40) continue;  // now and then everything rests
      at[i] += velocity[i];
      for (int d = 0; d < 3; ++d)
        if (at[i][d] > 2 || at[i][d] < -2) velocity[i][d] = -velocity[i][d];
      rig.move(proxies[i], cube(at[i].x(), at[i].y(), at[i].z()));
    }
    rig.calculate();
    ASSERT_TRUE(oracle.check(Rule::exact)) << "frame " << frame;
    std::map<Oracle::SerialPair, Remembered> now;
    for (int i = 0; i < rig.pair_count(); ++i) {
      btBroadphasePair& pair = rig.cache().getOverlappingPairArray()[i];
      const Oracle::SerialPair key = std::minmax(oracle.serial(pair.m_pProxy0), oracle.serial(pair.m_pProxy1));
      if (const auto before = held.find(key); before != held.end()) {
        ASSERT_EQ(pair.m_algorithm, before->second.algorithm) << "frame " << frame;
        ASSERT_EQ(pair.m_pProxy0, before->second.first) << "frame " << frame;
        ASSERT_EQ(pair.m_internalInfo1, before->second.info) << "frame " << frame;
      } else {
        ASSERT_EQ(pair.m_algorithm, nullptr) << "frame " << frame << ": a new pair comes with an algorithm";
        rig.plant(pair.m_pProxy0, pair.m_pProxy1);
        pair.m_internalInfo1 = &infos[static_cast<std::size_t>(begun) % infos.size()];
        ++begun;
      }
      now[key] = {pair.m_algorithm, pair.m_pProxy0, pair.m_internalInfo1};
    }
    for (const auto& [key, remembered] : held) ended += now.count(key) == 0;
    held = std::move(now);
    ASSERT_EQ(rig.algorithms_destroyed, ended) << "frame " << frame;
    ASSERT_EQ(ghost.adds(), begun) << "frame " << frame;
    ASSERT_EQ(ghost.removes(), ended) << "frame " << frame;
  }
  EXPECT_GT(begun, 1000);
  EXPECT_GT(ended, 1000);
  EXPECT_GT(held.size(), 100u);
  rig.cache().setInternalGhostPairCallback(nullptr);
}

TEST(BulletContract, P2_ContinuingPairsKeepTheirAlgorithmFor1000Frames) {
  auto* oracle = new Oracle(make_broadphase(Kind::subject));
  Rig rig;
  rig.broadphase.reset(oracle);
  run_thousand_frames(rig, *oracle);
}

TEST(BulletContract, P2_ContinuingPairsKeepTheirAlgorithmInAnExternalCache) {
  btHashedOverlappingPairCache cache;
  auto* oracle = new Oracle(make_broadphase(Kind::subject, &cache));
  Rig rig;
  rig.broadphase.reset(oracle);
  run_thousand_frames(rig, *oracle);
}

TEST(BulletContract, P3_NothingMovesUntilTheNextCalculate) {
  Rig rig;
  std::vector<btBroadphaseProxy*> heap = make_heap(rig, 200, 3, 4);
  rig.calculate();
  for (int i = 0; i < 200; i += 2) rig.move(heap[static_cast<std::size_t>(i)], cube(0, 0, btScalar(i)));
  rig.calculate();
  const btBroadphasePair* array = rig.cache().getOverlappingPairArrayPtr();
  const std::vector<btBroadphasePair> before(array, array + rig.pair_count());
  ASSERT_GT(before.size(), 20u);
  Random random(7);
  const auto query = [&] {
    const btVector3 p = random.vector(-4, 4);
    rig.in_box(cube(p.x(), p.y(), p.z()));
    rig.on_ray(btVector3(-50, p.y(), p.z()), btVector3(50, p.x(), p.y()));
    btVector3 lo, hi;
    rig.broadphase->getAabb(heap[0], lo, hi);
    rig.broadphase->getBroadphaseAabb(lo, hi);
    rig.cache().needsBroadphaseCollision(heap[0], heap[1]);
    rig.cache().findPair(heap[0], heap[1]);
  };
  struct QueryingVisit : btOverlapCallback {
    bool processOverlap(btBroadphasePair&) override {
      during();
      return false;
    }
    std::function<void()> during;
  } visit;
  visit.during = query;
  rig.cache().processAllOverlappingPairs(&visit, &rig.dispatcher, btDispatcherInfo());
  EXPECT_EQ(rig.cache().getOverlappingPairArrayPtr(), array);
  ASSERT_EQ(rig.pair_count(), static_cast<int>(before.size()));
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_TRUE(array[i] == before[i]) << i;
}

TEST(BulletContract, P4_SeparationIsSeenInTheSameCalculate) {
  for (const Kind kind : {Kind::dbvt, Kind::simple, Kind::subject}) {
    Rig rig(kind);
    std::vector<btBroadphaseProxy*> heap;
    for (int i = 0; i < 100; ++i) heap.push_back(rig.create(cube(0, 0, 0)));
    rig.calculate();
    ASSERT_EQ(rig.pair_count(), 4950) << kind;
    for (std::size_t i = 0; i < 100; ++i) rig.move(heap[i], cube(btScalar(4 * i), 0, 0));
    rig.calculate();
    if (kind == Kind::dbvt) {
      EXPECT_GT(rig.pair_count(), 4000);
      for (int i = 0; i < 50; ++i) rig.calculate();
      EXPECT_GT(rig.pair_count(), 0) << "Dbvt stops looking when the scene is still";
    } else {
      EXPECT_EQ(rig.pair_count(), 0) << kind;
    }
  }
}

TEST(BulletContract, P4_AlgorithmGoesBeforeTheGhostHears) {
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    Rig rig(kind);
    GhostLog ghost;
    rig.cache().setInternalGhostPairCallback(&ghost);
    btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
    btBroadphaseProxy* b = rig.create(cube(0, 0, 0));
    rig.calculate();
    rig.plant(a, b);
    int destroyed_when_told = -1;
    ghost.on_event = [&](const GhostLog::Event&) { destroyed_when_told = rig.algorithms_destroyed; };
    rig.move(a, cube(30, 0, 0));
    rig.calculate();
    EXPECT_EQ(rig.pair_count(), 0) << kind;
    EXPECT_EQ(destroyed_when_told, 1) << kind;
    EXPECT_EQ(ghost.removes(), 1) << kind;
    rig.cache().setInternalGhostPairCallback(nullptr);
  }
}

TEST(BulletContract, P4_ThereAndBackBetweenCalculatesIsNotASeparation) {
  Rig rig;
  GhostLog ghost;
  rig.cache().setInternalGhostPairCallback(&ghost);
  btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
  btBroadphaseProxy* b = rig.create(cube(0, 0, 0));
  rig.calculate();
  const btCollisionAlgorithm* algorithm = rig.plant(a, b);
  rig.move(a, cube(30, 0, 0));
  rig.move(a, cube(0, btScalar(0.1), 0));
  rig.calculate();
  ASSERT_TRUE(rig.holds(a, b));
  EXPECT_EQ(find_in_array(*rig.broadphase, a, b)->m_algorithm, algorithm);
  EXPECT_EQ(ghost.events.size(), 1u);
  rig.cache().setInternalGhostPairCallback(nullptr);
}

TEST(BulletContract, P7_HeldPairsAreNotFilteredAgain) {
  for (const Kind kind : all_kinds) {
    Rig rig(kind);
    btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
    btBroadphaseProxy* b = rig.create(cube(0, 0, 0));
    rig.calculate();
    const btCollisionAlgorithm* algorithm = rig.plant(a, b);
    a->m_collisionFilterMask = 0;
    for (int frame = 0; frame < 10; ++frame) {
      rig.move(a, cube(0, btScalar(frame) / 20, 0));
      rig.calculate();
      ASSERT_TRUE(rig.holds(a, b)) << kind;
    }
    EXPECT_EQ(find_in_array(*rig.broadphase, a, b)->m_algorithm, algorithm) << kind;
    rig.cache().cleanProxyFromPairs(a, &rig.dispatcher);  // often advised, does not help
    rig.calculate();
    EXPECT_TRUE(rig.holds(a, b)) << kind;
    rig.destroy(a);
    a = rig.create(cube(0, 0, 0), 1, 0);
    rig.calculate();
    EXPECT_FALSE(rig.holds(a, b)) << kind;
  }
}

TEST(BulletContract, P7_RefreshBroadphaseProxyFiltersAgain) {
  for (const Kind kind : all_kinds) {
    Rig rig(kind);
    btCollisionWorld world(&rig.dispatcher, rig.broadphase.get(), &rig.config);
    btBoxShape shape(btVector3(1, 1, 1));
    btCollisionObject a, b;
    for (btCollisionObject* object : {&a, &b}) {
      object->setCollisionShape(&shape);
      world.addCollisionObject(object);
    }
    world.performDiscreteCollisionDetection();
    ASSERT_EQ(rig.pair_count(), 1) << kind;
    const int old_uid = a.getBroadphaseHandle()->m_uniqueId;
    a.getBroadphaseHandle()->m_collisionFilterGroup = 4;
    a.getBroadphaseHandle()->m_collisionFilterMask = 8;
    world.performDiscreteCollisionDetection();
    EXPECT_EQ(rig.pair_count(), 1) << kind;
    world.refreshBroadphaseProxy(&a);
    EXPECT_EQ(a.getBroadphaseHandle()->m_collisionFilterGroup, 4) << kind;  // read back from the old proxy
    EXPECT_EQ(a.getBroadphaseHandle()->m_collisionFilterMask, 8) << kind;
    world.performDiscreteCollisionDetection();
    EXPECT_EQ(rig.pair_count(), 0) << kind;
    if (kind == Kind::dbvt || kind == Kind::subject) {
      EXPECT_GT(a.getBroadphaseHandle()->m_uniqueId, old_uid) << kind;
    }
    a.getBroadphaseHandle()->m_collisionFilterMask = -1;
    b.getBroadphaseHandle()->m_collisionFilterMask = -1;
    world.refreshBroadphaseProxy(&a);
    world.performDiscreteCollisionDetection();
    EXPECT_EQ(rig.pair_count(), 1) << kind;
    world.removeCollisionObject(&a);
    world.removeCollisionObject(&b);
  }
}

TEST(BulletContract, P8_FilterIsAskedOnlyAboutOverlappingPairs) {
  Rig rig;
  std::vector<btBroadphaseProxy*> heap = make_heap(rig, 300, 8, 5);
  std::map<UidPair, int> asked;
  FunctionFilter filter([&](btBroadphaseProxy* p, btBroadphaseProxy* q) {
    EXPECT_NE(p, q);
    EXPECT_TRUE(boxes_overlap(p->m_aabbMin, p->m_aabbMax, q->m_aabbMin, q->m_aabbMax));
    const UidPair pair = std::minmax(p->m_uniqueId, q->m_uniqueId);
    return ++asked[pair] == 1;  // stateful: refuses a pair the second time
  });
  rig.cache().setOverlapFilterCallback(&filter);
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), static_cast<int>(asked.size()));
  EXPECT_GT(asked.size(), 100u);
  const std::vector<UidPair> before = rig.pairs();
  for (int frame = 0; frame < 5; ++frame) {
    for (btBroadphaseProxy* proxy : heap) {
      const btVector3 step(0, btScalar(0.001), 0);  // all together, so that the same boxes go on overlapping
      rig.move(proxy, {proxy->m_aabbMin + step, proxy->m_aabbMax + step});
    }
    rig.calculate();
  }
  std::vector<UidPair> lost;
  const std::vector<UidPair> now = sorted(rig.pairs());
  for (const UidPair& pair : before)
    if (!std::binary_search(now.begin(), now.end(), pair)) lost.push_back(pair);
  EXPECT_LE(lost.size(), 2u) << "only rounding may part two boxes here";
  rig.cache().setOverlapFilterCallback(nullptr);
}

TEST(BulletContract, P8_StatefulFilters) {
  // Accepts every other time, whatever the pair: accepting makes the pair, and refusing is not final.
  for (const bool external : {false, true})
    for (const Kind kind : {Kind::simple, Kind::subject}) {
      btHashedOverlappingPairCache cache;
      Rig rig(kind, external ? &cache : nullptr);
      long questions = 0;
      FunctionFilter filter([&](auto, auto) { return ++questions % 2 == 1; });
      rig.cache().setOverlapFilterCallback(&filter);
      btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
      rig.create(cube(0, 0, 0));
      rig.calculate();
      EXPECT_EQ(rig.pair_count(), 1) << kind << (external ? ", external cache" : ", own cache");
      rig.move(a, cube(30, 0, 0));
      rig.calculate();
      questions = 1;  // the next answer is no
      for (int frame = 0; frame < 2; ++frame) {
        rig.move(a, cube(0, btScalar(frame) / 5, 0));
        rig.calculate();
        EXPECT_EQ(rig.pair_count(), frame) << kind << (external ? ", external cache" : ", own cache");
      }
      rig.cache().setOverlapFilterCallback(nullptr);
    }
}

/// A filter that users have written shows by what it refuses first. Later pairs are decided about by it too.
TEST(BulletContract, P8_AFilterThatShowsByARefusalIsKnown) {
  Rig rig;
  btBroadphaseProxy* const written = rig.create(cube(0, 0, 0), 2);
  btBroadphaseProxy* const refused = rig.create(cube(9, 0, 0), 1);
  rig.calculate();
  written->m_collisionFilterGroup = 1;
  written->m_collisionFilterMask = 4;
  rig.move(refused, cube(btScalar(0.5), 0, 0));
  rig.calculate();
  EXPECT_FALSE(rig.holds(written, refused));
  btBroadphaseProxy* const accepted = rig.create(cube(0, btScalar(0.5), 0), 4, 1);
  rig.calculate();
  EXPECT_TRUE(rig.holds(written, accepted));
  EXPECT_FALSE(rig.holds(written, refused));
}

TEST(BulletContract, P8_StaticAndKinematicPairsAreNotCulled) {
  for (const Kind kind : all_kinds) {
    Rig rig(kind);
    btCollisionWorld world(&rig.dispatcher, rig.broadphase.get(), &rig.config);
    btBoxShape shape(btVector3(1, 1, 1));
    std::deque<btCollisionObject> objects(4);
    objects[0].setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
    objects[1].setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
    objects[2].setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    objects[3].setCollisionFlags(btCollisionObject::CF_NO_CONTACT_RESPONSE);
    for (btCollisionObject& object : objects) {
      object.setCollisionShape(&shape);
      world.addCollisionObject(&object, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
    }
    world.performDiscreteCollisionDetection();
    EXPECT_EQ(rig.pair_count(), 6) << kind;
    for (btCollisionObject& object : objects) world.removeCollisionObject(&object);
  }
}

TEST(BulletContract, P12_PairsWithoutContactsKeepBodiesAwake) {
  for (const bool close : {true, false}) {
    for (const Kind kind : {Kind::dbvt, Kind::simple, Kind::subject}) {
      Rig rig(kind);
      btSequentialImpulseConstraintSolver solver;
      btDiscreteDynamicsWorld world(&rig.dispatcher, rig.broadphase.get(), &solver, &rig.config);
      world.setGravity(btVector3(0, 0, 0));
      btSphereShape sphere(1);
      btRigidBody at_rest(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &sphere, btVector3(1, 1, 1)));
      btRigidBody awake(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &sphere, btVector3(1, 1, 1)));
      // diagonal neighbours: boxes overlap at 1.7, spheres are 2.4 apart
      awake.setWorldTransform(
          btTransform(btQuaternion::getIdentity(), btVector3(close ? btScalar(1.7) : 30, btScalar(1.7), 0)));
      awake.setAngularVelocity(btVector3(0, 2, 0));  // stays awake, stays in place
      awake.setActivationState(DISABLE_DEACTIVATION);
      world.addRigidBody(&at_rest);
      world.addRigidBody(&awake);
      for (int step = 0; step < 300; ++step) world.stepSimulation(btScalar(1) / 60, 0);
      EXPECT_EQ(rig.pair_count(), close ? 1 : 0) << kind;
      EXPECT_EQ(rig.dispatcher.getNumManifolds() > 0 && rig.dispatcher.getManifoldByIndexInternal(0)->getNumContacts(),
                false);
      EXPECT_EQ(at_rest.isActive(), close) << kind;
      world.removeRigidBody(&at_rest);
      world.removeRigidBody(&awake);
    }
  }
}

TEST(BulletContract, P12_PairsOfSleepingBodiesAreKept) {
  for (const bool update_all : {true, false}) {
    for (const Kind kind : {Kind::dbvt, Kind::subject}) {
      Rig rig(kind);
      btSequentialImpulseConstraintSolver solver;
      btDiscreteDynamicsWorld world(&rig.dispatcher, rig.broadphase.get(), &solver, &rig.config);
      world.setForceUpdateAllAabbs(update_all);
      btBoxShape ground_shape(btVector3(20, 1, 20)), box(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)));
      btRigidBody ground(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &ground_shape));
      ground.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, -1, 0)));
      world.addRigidBody(&ground);
      btVector3 inertia;
      box.calculateLocalInertia(1, inertia);
      std::deque<btRigidBody> stack;
      for (int i = 0; i < 5; ++i) {
        stack.emplace_back(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &box, inertia));
        stack.back().setWorldTransform(
            btTransform(btQuaternion::getIdentity(), btVector3(0, btScalar(i) + btScalar(0.5), 0)));
        world.addRigidBody(&stack.back());
      }
      for (int step = 0; step < 400; ++step) world.stepSimulation(btScalar(1) / 60, 0);
      for (const btRigidBody& body : stack) EXPECT_EQ(body.getActivationState(), ISLAND_SLEEPING) << kind;
      EXPECT_EQ(rig.pair_count(), 5) << kind;
      const int island = stack[0].getIslandTag();
      for (const btRigidBody& body : stack) EXPECT_EQ(body.getIslandTag(), island) << kind;
      // Waking the top wakes the stack, because the pairs still tie it together.
      stack[4].activate();
      stack[4].setLinearVelocity(btVector3(0, 1, 0));
      world.stepSimulation(btScalar(1) / 60, 0);
      for (const btRigidBody& body : stack) EXPECT_TRUE(body.isActive()) << kind;
      for (btRigidBody& body : stack) world.removeRigidBody(&body);
      world.removeRigidBody(&ground);
    }
  }
}

TEST(BulletContract, P13_OrderIsAFunctionOfThePairSet) {
  // Two histories that end with the same boxes.
  Rig rigs[2];
  std::vector<btBroadphaseProxy*> heaps[2];
  for (int r = 0; r < 2; ++r) {
    heaps[r] = make_heap(rigs[r], 300, 13, 5);
    if (r == 1) {
      Random random(131);
      for (int frame = 0; frame < 15; ++frame) {
        for (btBroadphaseProxy* proxy : heaps[1]) {
          const btVector3 p = random.vector(-5, 5);
          rigs[1].move(proxy, cube(p.x(), p.y(), p.z()));
        }
        rigs[1].calculate();
      }
      for (std::size_t i = 300; i-- > 0;) rigs[1].move(heaps[1][i], {heaps[0][i]->m_aabbMin, heaps[0][i]->m_aabbMax});
    }
    rigs[r].calculate();
  }
  const std::vector<UidPair> order = rigs[0].pairs();
  EXPECT_GT(order.size(), 200u);
  EXPECT_EQ(order, rigs[1].pairs());
  EXPECT_EQ(order, sorted(order)) << "ascending unique ids";
}

TEST(BulletContract, P13_OrderWithEagerPairs) {
  // Pairs that a ghost got early stand where they would stand anyway, once calculated.
  std::vector<UidPair> orders[2];
  for (int r = 0; r < 2; ++r) {
    Rig rig;
    GhostLog log;
    if (r == 1) rig.cache().setInternalGhostPairCallback(&log);
    std::vector<btPairCachingGhostObject> ghosts(5);
    std::vector<btBroadphaseProxy*> proxies;
    for (int i = 0; i < 60; ++i) {
      const Box box = cube(btScalar(i) / 4, 0, 0);
      proxies.push_back(i % 12 == 0 ? rig.create_for(&ghosts[static_cast<std::size_t>(i / 12)], box) : rig.create(box));
    }
    for (int i = 59; i >= 0; --i)
      rig.move(proxies[static_cast<std::size_t>(i)], cube(btScalar(i) / 4, btScalar(i % 3) / 10, 0));
    rig.calculate();
    orders[r] = rig.pairs();
    rig.cache().setInternalGhostPairCallback(nullptr);
  }
  EXPECT_EQ(orders[0], orders[1]);
  EXPECT_EQ(orders[0], sorted(orders[0]));
}

TEST(BulletContract, P13_SameCallsSameOrderWithEveryCache) {
  for (const bool external : {false, true}) {
    std::vector<std::vector<UidPair>> runs[2];
    for (auto& run : runs) {
      btHashedOverlappingPairCache cache;
      Rig rig(Kind::subject, external ? &cache : nullptr);
      std::vector<btBroadphaseProxy*> heap = make_heap(rig, 150, 131, 3);
      Random random(132);
      for (int frame = 0; frame < 20; ++frame) {
        for (btBroadphaseProxy* proxy : heap) {
          const btVector3 p = random.vector(-3, 3);
          rig.move(proxy, cube(p.x(), p.y(), p.z()));
        }
        rig.destroy(heap.back());
        heap.pop_back();
        rig.calculate();
        run.push_back(rig.pairs());
      }
    }
    EXPECT_EQ(runs[0], runs[1]) << (external ? "external" : "own");
  }
}

}  // namespace
}  // namespace boxstream::bullet_test
