// SPDX-License-Identifier: MIT
// Section 2 of the contract: the virtuals of btBroadphaseInterface, proxies and unique ids.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btGhostObject.h>

#include <algorithm>
#include <limits>
#include <set>

#include "oracle.hpp"
#include "support.hpp"

namespace bullet_tests {
namespace {

/// A hashed cache that counts calls which change it.
class WatchedCache : public btHashedOverlappingPairCache {
 public:
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override {
    ++changes;
    return btHashedOverlappingPairCache::addOverlappingPair(a, b);
  }
  void* removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) override {
    ++changes;
    return btHashedOverlappingPairCache::removeOverlappingPair(a, b, dispatcher);
  }
  int changes = 0;
};

TEST(BulletContract, S2_DestructorLeavesExternalCacheAlone) {
  WatchedCache cache;
  {
    Rig rig(Kind::subject, &cache);
    rig.create(cube(0, 0, 0));
    rig.create(cube(0, 0, 0));
    rig.calculate();
    ASSERT_EQ(cache.getNumOverlappingPairs(), 1);
    cache.changes = 0;
    rig.broadphase.reset();
    EXPECT_EQ(cache.changes, 0);
    EXPECT_EQ(cache.getNumOverlappingPairs(), 1);
  }
}

TEST(BulletContract, S2_DestructorUsesNothingThatMayBeGone) {
  for (const bool external : {false, true}) {
    auto cache = external ? std::make_unique<btHashedOverlappingPairCache>() : nullptr;
    auto config = std::make_unique<btDefaultCollisionConfiguration>();
    auto dispatcher = std::make_unique<btCollisionDispatcher>(config.get());
    auto ghost = std::make_unique<GhostLog>();
    auto filter = std::make_unique<FunctionFilter>([](auto, auto) { return true; });
    auto clients = std::make_unique<btCollisionObject[]>(20);
    std::unique_ptr<btBroadphaseInterface> broadphase = make_broadphase(Kind::subject, cache.get());
    broadphase->getOverlappingPairCache()->setInternalGhostPairCallback(ghost.get());
    broadphase->getOverlappingPairCache()->setOverlapFilterCallback(filter.get());
    for (int i = 0; i < 20; ++i) {
      const Box box = cube(btScalar(i) / 2, 0, 0);
      broadphase->createProxy(box.lo, box.hi, BOX_SHAPE_PROXYTYPE, &clients[i], 1, -1, dispatcher.get());
      if (i == 10) broadphase->calculateOverlappingPairs(dispatcher.get());
    }
    ASSERT_GT(broadphase->getOverlappingPairCache()->getNumOverlappingPairs(), 0);
    clients.reset();
    filter.reset();
    ghost.reset();
    dispatcher.reset();
    config.reset();
    cache.reset();
    broadphase.reset();  // memory checkers watch this line
  }
}

TEST(BulletContract, I1_CreateCopiesItsArguments) {
  for (const Kind kind : all_kinds) {
    Rig rig(kind);
    btCollisionObject client;
    const Box box{btVector3(-1, -2, -3), btVector3(4, 5, 6)};
    const btBroadphaseProxy* proxy = rig.create_for(&client, box, 6, 9);
    ASSERT_NE(proxy, nullptr);
    EXPECT_EQ(proxy->m_clientObject, &client);
    EXPECT_EQ(proxy->m_collisionFilterGroup, 6);
    EXPECT_EQ(proxy->m_collisionFilterMask, 9);
    EXPECT_GE(proxy->m_uniqueId, 1);
    if (kind == Kind::axis16 || kind == Kind::axis32) continue;  // leaves the fields unset
    for (int d = 0; d < 3; ++d) {
      EXPECT_EQ(proxy->m_aabbMin[d], box.lo[d]) << kind;
      EXPECT_EQ(proxy->m_aabbMax[d], box.hi[d]) << kind;
    }
  }
}

TEST(BulletContract, I1_NeverNullAndAddressesStable) {
  Rig rig;
  btCollisionObject client;
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 20000; ++i) {
    proxies.push_back(rig.create_for(&client, cube(btScalar(2 * i), 0, 0), i, -1));
    ASSERT_NE(proxies.back(), nullptr);
  }
  for (int i = 0; i < 20000; i += 3) rig.destroy(proxies[static_cast<std::size_t>(i)]);
  rig.calculate();
  for (int i = 0; i < 20000; ++i)
    if (i % 3) {
      ASSERT_EQ(proxies[static_cast<std::size_t>(i)]->m_collisionFilterGroup, i);
      ASSERT_EQ(proxies[static_cast<std::size_t>(i)]->m_aabbMin.x(), btScalar(2 * i) - btScalar(0.5));
    }
}

TEST(BulletContract, I1_NullAndForeignClients) {
  for (const Kind kind : all_kinds) {
    Rig rig(kind);
    const btBroadphaseProxy* a = rig.create_for(nullptr, cube(0, 0, 0));
    const btBroadphaseProxy* b = rig.create_for(reinterpret_cast<btCollisionObject*>(17), cube(0, 0, 0));
    const btBroadphaseProxy* c = rig.create_for(reinterpret_cast<btCollisionObject*>(18), cube(0, 0, 0));
    rig.calculate();
    EXPECT_TRUE(rig.holds(b, c)) << kind;
    // btSimpleBroadphase takes a null client for a free slot; nobody else does.
    EXPECT_EQ(rig.holds(a, b), kind != Kind::simple) << kind;
    EXPECT_EQ(rig.in_box(cube(0, 0, 0)).size(), kind == Kind::simple ? 2u : 3u) << kind;
  }
}

TEST(BulletContract, I1_ForeignClientsWithAnExternalCache) {
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    btHashedOverlappingPairCache cache;
    Rig rig(kind, &cache);
    btBroadphaseProxy* a = rig.create_for(reinterpret_cast<btCollisionObject*>(17), cube(0, 0, 0));
    btBroadphaseProxy* b = rig.create_for(reinterpret_cast<btCollisionObject*>(18), cube(9, 0, 0));
    rig.move(b, cube(0, 0, 0));
    rig.calculate();
    EXPECT_TRUE(rig.holds(a, b)) << kind;
  }
}

TEST(BulletContract, I2_CallbacksSeeTheHandleOfTheNewObject) {
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    Rig rig(kind);
    btCollisionWorld world(&rig.dispatcher, rig.broadphase.get(), &rig.config);
    btSphereShape sphere(1);
    btCollisionObject a, b;
    bool handles_set = true;
    FunctionFilter filter([&](btBroadphaseProxy* p, btBroadphaseProxy* q) {
      for (btBroadphaseProxy* proxy : {p, q})
        if (static_cast<btCollisionObject*>(proxy->m_clientObject)->getBroadphaseHandle() != proxy) handles_set = false;
      return true;
    });
    rig.cache().setOverlapFilterCallback(&filter);
    for (btCollisionObject* object : {&a, &b}) {
      object->setCollisionShape(&sphere);
      world.addCollisionObject(object);
    }
    world.computeOverlappingPairs();
    EXPECT_EQ(rig.pair_count(), 1);
    EXPECT_GT(filter.calls, 0);
    EXPECT_EQ(handles_set, kind == Kind::subject) << kind;
    rig.cache().setOverlapFilterCallback(nullptr);
    world.removeCollisionObject(&a);
    world.removeCollisionObject(&b);
  }
}

TEST(BulletContract, I3_LastSetAabbWinsAndShowsAtOnce) {
  for (const Kind kind : all_kinds) {
    Rig rig(kind);
    btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
    btBroadphaseProxy* b = rig.create(cube(10, 0, 0));
    for (const btScalar x : {btScalar(3), btScalar(20), btScalar(9.5)}) {
      const Box box = cube(x, 0, 0);
      rig.move(a, box);
      EXPECT_EQ(a->m_aabbMin, box.lo) << kind;
      EXPECT_EQ(a->m_aabbMax, box.hi) << kind;
    }
    rig.calculate();
    EXPECT_TRUE(rig.holds(a, b)) << kind;
    rig.move(a, cube(10, 0, 0));
    rig.move(a, cube(50, 0, 0));
    rig.calculate();
    if (kind == Kind::subject) {
      EXPECT_EQ(rig.pair_count(), 0);
    }
  }
}

TEST(BulletContract, I3_UnchangedBoxesChangeNothing) {
  Rig rig;
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 50; ++i) proxies.push_back(rig.create(cube(btScalar(i) * btScalar(0.75), 0, 0)));
  rig.calculate();
  GhostLog ghost;
  rig.cache().setInternalGhostPairCallback(&ghost);
  const std::vector<UidPair> before = rig.pairs();
  ASSERT_EQ(before.size(), 49u);
  for (int frame = 0; frame < 5; ++frame) {
    for (btBroadphaseProxy* proxy : proxies) {
      const btVector3 lo = proxy->m_aabbMin, hi = proxy->m_aabbMax;
      rig.move(proxy, {lo, hi});
    }
    rig.calculate();
    EXPECT_EQ(rig.pairs(), before);
  }
  EXPECT_TRUE(ghost.events.empty());
  rig.cache().setInternalGhostPairCallback(nullptr);
}

TEST(BulletContract, I3_SetAabbWithNullDispatcher) {
  for (const Kind kind : all_kinds) {
    Rig rig(kind);
    btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
    rig.create(cube(4, 0, 0));
    const Box box = cube(4, 0, 0);
    rig.broadphase->setAabb(a, box.lo, box.hi, nullptr);
    rig.broadphase->calculateOverlappingPairs(nullptr);
    EXPECT_EQ(rig.pair_count(), 1) << kind;
  }
}

TEST(BulletContract, S2_GetAabbIsTheLastBoxPassed) {
  Rig rig;
  btBroadphaseProxy* proxy = rig.create(cube(1, 2, 3));
  btVector3 lo, hi;
  rig.broadphase->getAabb(proxy, lo, hi);
  EXPECT_EQ(lo, cube(1, 2, 3).lo);
  EXPECT_EQ(hi, cube(1, 2, 3).hi);
  for (int i = 0; i < 10; ++i) {  // small steps, where a fattened box would stay behind
    const Box box = cube(1 + btScalar(i) / 100, 2, 3);
    rig.move(proxy, box);
    rig.broadphase->getAabb(proxy, lo, hi);
    EXPECT_EQ(lo, box.lo);
    EXPECT_EQ(hi, box.hi);
    rig.calculate();
    EXPECT_EQ(proxy->m_aabbMin, box.lo);
    EXPECT_EQ(proxy->m_aabbMax, box.hi);
  }
}

TEST(BulletContract, I4_CalculateIsCompleteDenseAndIdempotent) {
  auto* oracle = new Oracle(make_broadphase(Kind::subject));
  Rig rig;
  rig.broadphase.reset(oracle);
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const btVector3 p = random.vector(-5, 5);
    rig.create(cube(p.x(), p.y(), p.z()));
  }
  rig.calculate();
  ASSERT_TRUE(oracle->check(Rule::exact));
  ASSERT_GT(rig.pair_count(), 100);
  const std::vector<UidPair> once = rig.pairs();
  for (int i = 0; i < 3; ++i) {
    rig.calculate();
    EXPECT_EQ(rig.pairs(), once);
  }
}

TEST(BulletContract, I4_CalculateWithNullDispatcher) {
  for (const Kind kind : all_kinds) {
    std::unique_ptr<btBroadphaseInterface> broadphase = make_broadphase(kind);
    int clients[3];
    btBroadphaseProxy* proxies[3];
    for (int i = 0; i < 3; ++i) {
      const Box box = cube(0, 0, 0);
      proxies[i] = broadphase->createProxy(box.lo, box.hi, BOX_SHAPE_PROXYTYPE, &clients[i], 1, -1, nullptr);
    }
    broadphase->calculateOverlappingPairs(nullptr);
    EXPECT_EQ(pairs_of(*broadphase).size(), 3u) << kind;
    const Box far = cube(50, 0, 0);
    broadphase->setAabb(proxies[2], far.lo, far.hi, nullptr);
    broadphase->calculateOverlappingPairs(nullptr);
    if (kind != Kind::dbvt && kind != Kind::dbvt_deferred) {  // which look at a tenth of the pairs
      EXPECT_EQ(pairs_of(*broadphase).size(), 1u) << kind;
    }
    for (btBroadphaseProxy* proxy : proxies) broadphase->destroyProxy(proxy, nullptr);
    EXPECT_EQ(pairs_of(*broadphase).size(), 0u) << kind;
  }
}

TEST(BulletContract, I4_CallbacksInsideCalculateMayQuery) {
  Rig rig;
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 30; ++i) proxies.push_back(rig.create(cube(btScalar(i) * btScalar(0.75), 0, 0)));
  std::vector<std::size_t> seen;
  GhostLog ghost;
  ghost.on_event = [&](const GhostLog::Event&) {
    seen.push_back(rig.in_box(cube(100, 0, 0, 1)).size());
    seen.push_back(rig.on_ray(btVector3(100, -5, 0), btVector3(100, 5, 0)).size());
  };
  rig.cache().setInternalGhostPairCallback(&ghost);
  FunctionFilter filter([&](auto, auto) {
    seen.push_back(rig.in_box(cube(100, 0, 0, 1)).size());
    return true;
  });
  rig.cache().setOverlapFilterCallback(&filter);
  rig.move(proxies[29], cube(100, 0, 0));
  rig.calculate();  // adds 28 pairs
  EXPECT_EQ(rig.pair_count(), 28);
  rig.move(proxies[28], cube(100, 10, 0));
  rig.calculate();  // removes one
  EXPECT_EQ(rig.pair_count(), 27);
  EXPECT_GE(seen.size(), 28u + 2 * 29u);
  for (const std::size_t count : seen) EXPECT_EQ(count, 1u);
  rig.cache().setInternalGhostPairCallback(nullptr);
  rig.cache().setOverlapFilterCallback(nullptr);
}

TEST(BulletContract, I4_ContactCallbacksInsideCalculateMayQuery) {
  static Rig* current;
  static int ended;
  Rig rig;
  current = &rig;
  ended = 0;
  btCollisionWorld world(&rig.dispatcher, rig.broadphase.get(), &rig.config);
  btSphereShape sphere(1);
  std::deque<btCollisionObject> objects(6);
  for (int i = 0; i < 6; ++i) {
    objects[static_cast<std::size_t>(i)].setCollisionShape(&sphere);
    objects[static_cast<std::size_t>(i)].getWorldTransform().setOrigin(btVector3(btScalar(i) * btScalar(1.5), 0, 0));
    world.addCollisionObject(&objects[static_cast<std::size_t>(i)]);
  }
  world.performDiscreteCollisionDetection();
  ASSERT_EQ(rig.dispatcher.getNumManifolds(), 5);
  gContactEndedCallback = [](btPersistentManifold* const&) {
    ++ended;
    EXPECT_EQ(current->in_box(cube(0, 0, 0, 100)).size(), 6u);
    EXPECT_GE(current->on_ray(btVector3(-50, 0, 0), btVector3(50, 0, 0)).size(), 1u);
  };
  for (int i = 0; i < 6; i += 2) {  // separates every pair, so calculate releases every manifold
    objects[static_cast<std::size_t>(i)].getWorldTransform().setOrigin(btVector3(btScalar(i), 40, 0));
    world.updateSingleAabb(&objects[static_cast<std::size_t>(i)]);
  }
  world.computeOverlappingPairs();
  EXPECT_EQ(ended, 5);
  EXPECT_EQ(rig.dispatcher.getNumManifolds(), 0);
  gContactEndedCallback = nullptr;
  for (btCollisionObject& object : objects) world.removeCollisionObject(&object);
}

TEST(BulletContract, S2_PairCacheIsTheSameForLife) {
  Rig rig;
  btOverlappingPairCache* cache = rig.broadphase->getOverlappingPairCache();
  ASSERT_NE(cache, nullptr);
  btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
  rig.create(cube(0, 0, 0));
  EXPECT_EQ(rig.broadphase->getOverlappingPairCache(), cache);
  rig.calculate();
  rig.destroy(a);
  rig.broadphase->resetPool(&rig.dispatcher);
  EXPECT_EQ(rig.broadphase->getOverlappingPairCache(), cache);
  EXPECT_EQ(std::as_const(*rig.broadphase).getOverlappingPairCache(), cache);
}

TEST(BulletContract, S2_BroadphaseAabbContainsAllProxies) {
  for (const Kind kind : {Kind::dbvt, Kind::simple, Kind::subject}) {
    Rig rig(kind);
    btVector3 lo, hi;
    rig.broadphase->getBroadphaseAabb(lo, hi);
    for (int d = 0; d < 3; ++d) EXPECT_TRUE(lo[d] <= hi[d]) << kind;  // no NaN, nothing inverted when empty
    Random random(2);
    for (int i = 0; i < 100; ++i) {
      const btVector3 p = random.vector(-90, 90);
      btBroadphaseProxy* proxy = rig.create(cube(p.x(), p.y(), p.z()));
      if (i % 2) rig.move(proxy, cube(p.y(), p.z(), 2 * p.x()));
      rig.broadphase->getBroadphaseAabb(lo, hi);
      for (int d = 0; d < 3; ++d) {
        ASSERT_LE(lo[d], proxy->m_aabbMin[d]) << kind;
        ASSERT_GE(hi[d], proxy->m_aabbMax[d]) << kind;
      }
    }
  }
}

TEST(BulletContract, S2_ResetPoolRestartsUidsWhenEmpty) {
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    Rig rig(kind);
    std::vector<int> runs[2];
    std::vector<UidPair> pairs[2];
    for (int run = 0; run < 2; ++run) {
      std::vector<btBroadphaseProxy*> proxies;
      for (int i = 0; i < 40; ++i) {
        proxies.push_back(rig.create(cube(btScalar(i % 7), btScalar(i % 5), 0)));
        if (i % 6 == 5) {
          rig.destroy(proxies[proxies.size() - 3]);
          proxies.erase(proxies.end() - 3);
        }
      }
      rig.calculate();
      pairs[run] = rig.pairs();
      for (btBroadphaseProxy* proxy : proxies) {
        runs[run].push_back(proxy->m_uniqueId);
        rig.destroy(proxy);
      }
      rig.calculate();
      rig.broadphase->resetPool(&rig.dispatcher);
    }
    EXPECT_EQ(runs[0], runs[1]) << kind;
    EXPECT_EQ(runs[0][0], 1) << kind;
    ASSERT_FALSE(pairs[0].empty());
    if (kind == Kind::subject) {
      EXPECT_EQ(pairs[0], pairs[1]) << "order of the pair array";
    } else {
      EXPECT_EQ(sorted(pairs[0]), sorted(pairs[1]));
    }
  }
}

TEST(BulletContract, S2_ResetPoolIsHarmlessWhenNotEmpty) {
  for (const Kind kind : all_kinds) {
    if (kind == Kind::simple) continue;  // its override is protected in the header, and does nothing
    Rig rig(kind);
    btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
    btBroadphaseProxy* b = rig.create(cube(0, 0, 0));
    rig.calculate();
    const btCollisionAlgorithm* algorithm = rig.plant(a, b);
    const int uids[] = {a->m_uniqueId, b->m_uniqueId};
    rig.broadphase->resetPool(&rig.dispatcher);
    EXPECT_EQ(a->m_uniqueId, uids[0]) << kind;
    EXPECT_EQ(b->m_uniqueId, uids[1]) << kind;
    const btBroadphaseProxy* c = rig.create(cube(0, 0, 0));
    EXPECT_NE(c->m_uniqueId, uids[0]) << kind;
    EXPECT_NE(c->m_uniqueId, uids[1]) << kind;
    rig.calculate();
    EXPECT_EQ(rig.pair_count(), 3) << kind;
    ASSERT_TRUE(rig.holds(a, b)) << kind;
    EXPECT_EQ(find_in_array(*rig.broadphase, a, b)->m_algorithm, algorithm) << kind;
    rig.destroy(a);
    EXPECT_EQ(rig.algorithms_destroyed, 1) << kind;
  }
}

TEST(BulletContract, S2_PrintStatsPrintsNothing) {
  Rig rig;
  rig.create(cube(0, 0, 0));
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  rig.broadphase->printStats();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// Of proxies whose box is not set, only some are looked at in each batch.
TEST(BulletContract, I9_MasksOfManyAtRestAreNoticed) {
  Rig rig;
  std::vector<btBroadphaseProxy*> row;
  for (int i = 0; i < 1000; ++i) row.push_back(rig.create(cube(btScalar(10 * (i / 2)), 0, 0), 1, 1));
  rig.calculate();
  ASSERT_EQ(rig.pair_count(), 500);
  btBroadphaseProxy* const mover = rig.create(cube(-100, 0, 0), 1, 1);
  for (int batch = 0; batch < 20; ++batch) rig.calculate();
  for (int i = 600; i < 602; ++i) row[std::size_t(i)]->m_collisionFilterMask = 0;
  rig.move(mover, cube(3000, 0, 0));  // onto these two, whatever the World has been told
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 500);
  for (int i = 600; i < 602; ++i) row[std::size_t(i)]->m_collisionFilterMask = 1;
  for (int batch = 0; batch < 16; ++batch) rig.calculate();
  EXPECT_EQ(rig.pair_count(), 502);
}

TEST(BulletContract, I9_GroupAndMaskAreReadLive) {
  for (const Kind kind : all_kinds) {
    Rig rig(kind);
    btBroadphaseProxy* a = rig.create(cube(0, 0, 0), 1, 1);
    btBroadphaseProxy* b = rig.create(cube(0, 10, 0), 1, 1);
    rig.calculate();
    a->m_collisionFilterMask = 0;  // before they ever meet
    rig.move(b, cube(0, 0, 0));
    rig.calculate();
    EXPECT_EQ(rig.pair_count(), 0) << kind;
    a->m_collisionFilterMask = 1;  // all natives notice at the next move that is more than their margin
    rig.move(b, cube(0, btScalar(0.2), 0));
    rig.calculate();
    if (kind != Kind::axis16 && kind != Kind::axis32) {  // whose edges did not cross
      EXPECT_EQ(rig.pair_count(), 1) << kind;
    }
    a->m_collisionFilterGroup = 2;  // b's mask refuses it, but the pair is held
    rig.move(b, cube(0, btScalar(0.1), 0));
    rig.calculate();
    if (kind != Kind::axis16 && kind != Kind::axis32) {
      EXPECT_EQ(rig.pair_count(), 1) << kind;
    }
    rig.move(b, cube(0, 10, 0));
    rig.calculate();
    rig.move(b, cube(0, 0, 0));
    rig.calculate();
    EXPECT_EQ(rig.pair_count(), 0) << kind;
  }
}

TEST(BulletContract, I9_ClientsAreReadLive) {
  Rig rig;
  GhostLog ghost;
  rig.cache().setInternalGhostPairCallback(&ghost);
  btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
  rig.create(cube(0, 10, 0));
  btPairCachingGhostObject client;  // the callback decides by the client as it is now
  a->m_clientObject = &client;
  rig.move(a, cube(0, 10, 0));
  EXPECT_EQ(rig.pair_count(), 1) << "the client is a ghost now, so the pair comes at once";
  rig.calculate();
  ASSERT_EQ(ghost.events.size(), 1u);
  EXPECT_EQ(ghost.events[0].client0, &client);
  rig.cache().setInternalGhostPairCallback(nullptr);
}

TEST(BulletContract, I11_ExternalCacheIsUsedAndNotOwned) {
  for (const Kind kind : all_kinds) {
    btHashedOverlappingPairCache cache;
    {
      Rig rig(kind, &cache);
      EXPECT_EQ(rig.broadphase->getOverlappingPairCache(), &cache) << kind;
      btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
      btBroadphaseProxy* b = rig.create(cube(0, 0, 0));
      rig.calculate();
      EXPECT_EQ(cache.getNumOverlappingPairs(), 1) << kind;
      rig.destroy(a);
      rig.destroy(b);
      EXPECT_EQ(cache.getNumOverlappingPairs(), 0) << kind;
    }
    EXPECT_EQ(cache.GetCount(), 0) << kind;  // alive and usable after the broad-phase
  }
}

TEST(BulletContract, I11_ConfiguredThroughTheTypedPointer) {
  btHashedOverlappingPairCache cache;
  FunctionFilter refuse([](auto, auto) { return false; });
  cache.setOverlapFilterCallback(&refuse);  // before the broad-phase exists
  Rig rig(Kind::subject, &cache);
  btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
  rig.create(cube(0, 0, 0));
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 0);
  EXPECT_GT(refuse.calls, 0);
  cache.setOverlapFilterCallback(nullptr);
  GhostLog ghost;
  rig.cache().setInternalGhostPairCallback(&ghost);
  rig.move(a, cube(0, btScalar(0.2), 0));
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 1);
  EXPECT_EQ(ghost.adds(), 1);
}

/// What a program has set says nothing about the libraries it is linked with.
TEST(BulletContract, A2_NoSettingIsTakenForTheOtherPrecision) {
  const btScalar margin = gDbvtMargin, threshold = gContactBreakingThreshold;
  constexpr btScalar inf = std::numeric_limits<btScalar>::infinity();
  for (const btScalar value : {btScalar(6e4), btScalar(1e18), btScalar(-1), btScalar(1e-30), inf, inf - inf}) {
    gDbvtMargin = gContactBreakingThreshold = value;
    Rig rig;
    rig.create(cube(0, 0, 0));
    rig.create(cube(1, 0, 0));
    rig.calculate();
    EXPECT_EQ(rig.pair_count(), 1) << value;
  }
  gDbvtMargin = margin;
  gContactBreakingThreshold = threshold;
}

}  // namespace
}  // namespace bullet_tests
