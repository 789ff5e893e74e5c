// SPDX-License-Identifier: MIT
// Section 2 of the contract: a broad-phase, its cache and its proxies, from making to destroying.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <algorithm>
#include <limits>
#include <set>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
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
    // btSimpleBroadphase takes a null client for a free slot; no other broad-phase does.
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
}  // namespace boxstream::bullet_test
