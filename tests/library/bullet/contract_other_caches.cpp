// SPDX-License-Identifier: MIT
// Section 3 of the contract: caches of other kinds that callers supply. None, sorted ones, derived ones, those of
// ghosts.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>

#include <algorithm>
#include <memory>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

TEST(BulletContract, C3_NullCacheMakesNoPairsButQueriesWork) {
  for (const Kind kind : {Kind::dbvt, Kind::simple, Kind::subject}) {
    btNullPairCache cache;
    Rig rig(kind, &cache);
    std::vector<btBroadphaseProxy*> row = make_row(rig, 20);
    rig.calculate();
    EXPECT_EQ(rig.pair_count(), 0) << kind;
    EXPECT_EQ(cache.getOverlappingPairArray().size(), 0) << kind;
    EXPECT_EQ(rig.in_box(cube(0, 0, 0, btScalar(0.1))).size(), 2u) << kind;
    rig.move(row[0], cube(100, 0, 0));
    EXPECT_EQ(rig.in_box(cube(100, 0, 0, btScalar(0.1))).size(), 1u) << kind;
    EXPECT_GE(rig.on_ray(btVector3(100, -5, 0), btVector3(100, 5, 0)).size(), 1u) << kind;
    rig.calculate();
    rig.destroy(row[0]);
    EXPECT_EQ(rig.in_box(cube(100, 0, 0, btScalar(0.1))).size(), 0u) << kind;
  }
}

TEST(BulletContract, C3_NullCacheSkipsTheWorkForPairs) {
  btNullPairCache cache;
  Rig rig(Kind::subject, &cache);
  btCollisionObject client;
  for (int i = 0; i < 5000; ++i) rig.create_for(&client, cube(0, 0, 0));  // 12 million pairs
  for (int i = 0; i < 3; ++i) rig.calculate();
  EXPECT_EQ(cache.getOverlappingPairArray().size(), 0);
}

/// Two overlapping boxes and one apart.
void expect_one_pair(btOverlappingPairCache& cache) {
  Rig rig(Kind::subject, &cache);
  rig.create(cube(0, 0, 0));
  rig.create(cube(1, 0, 0));
  rig.create(cube(5, 0, 0));
  rig.calculate();
  EXPECT_EQ(rig.pairs(), (std::vector<UidPair>{{1, 2}}));
}

/// A mask that is written, refuses a pair, and is then written back.
TEST(BulletContract, P8_AMaskThatIsPutBackIsSeen) {
  btHashedOverlappingPairCache hashed;
  btSortedOverlappingPairCache sorted_cache;
  for (btOverlappingPairCache* cache :
       {static_cast<btOverlappingPairCache*>(nullptr), static_cast<btOverlappingPairCache*>(&hashed),
        static_cast<btOverlappingPairCache*>(&sorted_cache)}) {
    Rig rig(Kind::subject, cache);
    btBroadphaseProxy* const written = rig.create(cube(0, 0, 0));
    rig.calculate();
    written->m_collisionFilterMask = 4;
    btBroadphaseProxy* const other = rig.create(cube(0, 0, 0));
    rig.calculate();
    EXPECT_FALSE(rig.holds(written, other));
    written->m_collisionFilterMask = -1;
    rig.calculate();
    EXPECT_TRUE(rig.holds(written, other));
  }
}

/// What a refusal shows of a mask that was written is not taken for all that has changed, among so many proxies that a
/// batch looks at some masks only.
TEST(BulletContract, P8_AMaskThatShowsByARefusalIsSeen) {
  FunctionFilter by_masks([](const btBroadphaseProxy* a, const btBroadphaseProxy* b) {
    return (a->m_collisionFilterGroup & b->m_collisionFilterMask) != 0 &&
           (b->m_collisionFilterGroup & a->m_collisionFilterMask) != 0;
  });
  btHashedOverlappingPairCache hashed;
  for (btOverlappingPairCache* cache :
       {static_cast<btOverlappingPairCache*>(nullptr), static_cast<btOverlappingPairCache*>(&hashed)}) {
    Rig rig(Kind::subject, cache);
    if (cache == nullptr) rig.cache().setOverlapFilterCallback(&by_masks);
    const std::vector<btBroadphaseProxy*> row = make_row(rig, 200);
    btBroadphaseProxy* const written = rig.create(cube(0, 50, 0), 1, 0);
    btBroadphaseProxy* const accepted = rig.create(cube(0, 50, 0), 2, -1);
    btBroadphaseProxy* const refused = rig.create(cube(0, 60, 0), 4, -1);
    for (int i = 0; i < 20; ++i) rig.calculate();
    EXPECT_FALSE(rig.holds(written, accepted));
    written->m_collisionFilterMask = 2;
    rig.move(refused, cube(0, 50, 0));
    for (int i = 0; i < 5; ++i) rig.calculate();
    EXPECT_TRUE(rig.holds(written, accepted));
    EXPECT_FALSE(rig.holds(written, refused));
  }
}

TEST(BulletContract, C3_EveryOtherCacheKeepsPairs) {
  struct WithoutFilter : btHashedOverlappingPairCache {
    btOverlapFilterCallback* getOverlapFilterCallback() override { return nullptr; }
    void setOverlapFilterCallback(btOverlapFilterCallback*) override {}
  } without_filter;
  expect_one_pair(without_filter);
  struct WithoutArray : btSortedOverlappingPairCache {
    WithoutArray() { getOverlappingPairArray().clear(); }  // no capacity either, as btNullPairCache has none
  } without_array;
  expect_one_pair(without_array);
  struct Null : btNullPairCache {};
  Null null;
  Rig rig(Kind::subject, &null);
  const std::vector<btBroadphaseProxy*> row = make_row(rig, 20);
  for (int i = 0; i < 3; ++i) rig.calculate();
  EXPECT_EQ(rig.pair_count(), 0);
  EXPECT_EQ(rig.in_box(cube(0, 0, 0, btScalar(0.1))).size(), 2u);
}

TEST(BulletContract, C3_TheUsersCallbacksAreNotTouched) {
  struct Watched : btHashedOverlappingPairCache {
    void setOverlapFilterCallback(btOverlapFilterCallback* callback) override {
      ++writes;
      btHashedOverlappingPairCache::setOverlapFilterCallback(callback);
    }
    void setInternalGhostPairCallback(btOverlappingPairCallback*) override { ++writes; }
    int writes = 0;
  } cache;
  FunctionFilter filter([](btBroadphaseProxy*, btBroadphaseProxy*) { return true; });
  cache.btHashedOverlappingPairCache::setOverlapFilterCallback(&filter);
  expect_one_pair(cache);
  EXPECT_EQ(cache.writes, 0);
  EXPECT_EQ(cache.btHashedOverlappingPairCache::getOverlapFilterCallback(), &filter);
  EXPECT_GT(filter.calls, 0);
}

TEST(BulletContract, C4_SortedCacheEqualsTheOracle) {
  // btSimpleBroadphase cleans only a sorted cache of its own, so AxisSweep is the witness.
  for (const Kind kind : {Kind::axis32, Kind::subject}) {
    btSortedOverlappingPairCache cache;
    ASSERT_TRUE(cache.hasDeferredRemoval());
    auto* oracle = new Oracle(make_broadphase(kind, &cache));
    Rig rig;
    rig.broadphase.reset(oracle);
    Random random(44);
    std::vector<btBroadphaseProxy*> live;
    for (int i = 0; i < 60; ++i) live.push_back(rig.create(cube(0, btScalar(i) / 4, 0)));
    for (int frame = 0; frame < 40; ++frame) {
      for (btBroadphaseProxy* proxy : live)
        if (random.below(2)) {
          const btVector3 p = random.vector(-2, 2);
          rig.move(proxy, cube(p.x(), p.y(), p.z()));
        }
      rig.calculate();
      ASSERT_TRUE(oracle->check(kind == Kind::subject ? Rule::exact : Rule::superset)) << kind << ", frame " << frame;
      for (int i = 0; i < rig.pair_count(); ++i) {
        const btBroadphasePair& pair = cache.getOverlappingPairArray()[i];
        if (!pair.m_algorithm && random.below(3) == 0) rig.plant(pair.m_pProxy0, pair.m_pProxy1);
      }
      if (frame % 5 == 4) {
        rig.destroy(live.back());
        live.pop_back();
      }
    }
    EXPECT_GT(rig.algorithms_destroyed, 20) << kind;
    for (btBroadphaseProxy* proxy : live) rig.destroy(proxy);
    if (kind == Kind::subject) {  // AxisSweep leaves pairs of dead proxies in a sorted cache
      EXPECT_EQ(rig.pair_count(), 0);
      EXPECT_EQ(rig.dispatcher.freed, rig.dispatcher.allocated);
    }
  }
}

TEST(BulletContract, C4_SortedCacheKeepsContinuingPairs) {
  btSortedOverlappingPairCache cache;
  Rig rig(Kind::subject, &cache);
  std::vector<btBroadphaseProxy*> row = make_row(rig, 30);
  rig.calculate();
  std::vector<const btCollisionAlgorithm*> algorithms;
  for (std::size_t i = 0; i + 1 < 30; ++i) algorithms.push_back(rig.plant(row[i], row[i + 1]));
  for (int frame = 0; frame < 50; ++frame) {
    for (std::size_t i = 0; i < 30; ++i)
      rig.move(row[i], cube(btScalar(i) / 2, btScalar(frame % 7) / 10 * btScalar(i % 2), 0));
    rig.calculate();
    for (std::size_t i = 0; i + 1 < 30; ++i) {
      const btBroadphasePair* pair = find_in_array(*rig.broadphase, row[i], row[i + 1]);
      ASSERT_NE(pair, nullptr);
      ASSERT_EQ(pair->m_algorithm, algorithms[i]);
    }
  }
  EXPECT_EQ(rig.algorithms_destroyed, 0);
}

TEST(BulletContract, C4_SortedCacheMayGrowAndShrinkInTurn) {
  // Pairs change places although none ends, and again when the proxy of one is destroyed.
  btSortedOverlappingPairCache cache;
  Rig rig(Kind::subject, &cache);
  std::vector<btBroadphaseProxy*> row = make_row(rig, 2);
  rig.calculate();
  row[0]->m_collisionFilterMask = 0;  // what is held stays, and would not begin again
  std::vector<btBroadphaseProxy*> far_away;
  for (int i = 0; i < 2; ++i) far_away.push_back(rig.create(cube(100, btScalar(i) / 2, 0)));
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 2);
  rig.destroy(far_away[1]);
  rig.calculate();
  EXPECT_EQ(rig.pairs(), (std::vector<UidPair>{{1, 2}}));
  rig.move(row[0], cube(-100, 0, 0));
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 0);
}

TEST(BulletContract, C4_UsersMayRemovePairsFromASortedCache) {
  btSortedOverlappingPairCache cache;
  Rig rig(Kind::subject, &cache);
  const std::vector<btBroadphaseProxy*> row = make_row(rig, 6);
  rig.calculate();
  const std::vector<UidPair> before = rig.pairs();
  cache.getOverlappingPairArray().swap(0, 4);
  cache.getOverlappingPairArray().pop_back();
  for (int frame = 0; frame < 3; ++frame) {
    rig.calculate();
    EXPECT_EQ(rig.pairs(), before) << frame;
  }
  for (std::size_t i = 0; i < row.size(); ++i) rig.move(row[i], cube(btScalar(i) * 10, 0, 0));
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 0);
}

/// What users derive: keeps the type, watches the traffic.
class DerivedCache : public btHashedOverlappingPairCache {
 public:
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override {
    btBroadphasePair* pair = btHashedOverlappingPairCache::addOverlappingPair(a, b);
    balance += pair != nullptr;
    return pair;
  }
  void* removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) override {
    balance -= findPair(a, b) != nullptr;
    return btHashedOverlappingPairCache::removeOverlappingPair(a, b, dispatcher);
  }
  int balance = 0;
};

TEST(BulletContract, C5_DerivedCachesAreDrivenThroughTheirVirtuals) {
  DerivedCache cache;
  auto* oracle = new Oracle(make_broadphase(Kind::subject, &cache));
  Rig rig;
  rig.broadphase.reset(oracle);
  Random random(5);
  std::vector<btBroadphaseProxy*> live;
  for (int i = 0; i < 400; ++i) live.push_back(rig.create(cube(0, 0, btScalar(i))));
  for (int frame = 0; frame < 20; ++frame) {
    for (btBroadphaseProxy* proxy : live) {
      const btVector3 p = random.vector(-4, 4);
      rig.move(proxy, cube(p.x(), p.y(), p.z()));
    }
    rig.calculate();
    ASSERT_TRUE(oracle->check(Rule::exact));
    ASSERT_EQ(cache.balance, cache.GetCount());
  }
  ASSERT_GT(cache.GetCount(), 500);
  for (const auto& [a, b] : rig.pairs()) {  // the table behind the array is sound
    const auto proxy = [&](int uid) {
      return *std::find_if(live.begin(), live.end(), [uid](auto* p) { return p->m_uniqueId == uid; });
    };
    ASSERT_EQ(cache.findPair(proxy(a), proxy(b)), find_in_array(*rig.broadphase, proxy(a), proxy(b)));
  }
}

TEST(BulletContract, C6_BothAlgorithmsOfAGhostPairAreFreed) {
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    Rig rig(kind);
    btGhostPairCallback ghost_callback;
    rig.cache().setInternalGhostPairCallback(&ghost_callback);
    btCollisionWorld world(&rig.dispatcher, rig.broadphase.get(), &rig.config);
    btBoxShape shape(btVector3(1, 1, 1));
    auto ghost = std::make_unique<btPairCachingGhostObject>();
    auto box = std::make_unique<btCollisionObject>();
    ghost->setCollisionShape(&shape);
    box->setCollisionShape(&shape);
    world.addCollisionObject(box.get());
    world.addCollisionObject(ghost.get());
    world.performDiscreteCollisionDetection();
    ASSERT_EQ(ghost->getOverlappingPairCache()->getNumOverlappingPairs(), 1) << kind;
    world.getDispatcher()->dispatchAllCollisionPairs(ghost->getOverlappingPairCache(), world.getDispatchInfo(),
                                                     &rig.dispatcher);
    EXPECT_NE(ghost->getOverlappingPairCache()->getOverlappingPairArray()[0].m_algorithm, nullptr) << kind;
    EXPECT_NE(rig.cache().getOverlappingPairArray()[0].m_algorithm, nullptr) << kind;
    EXPECT_NE(ghost->getOverlappingPairCache()->getOverlappingPairArray()[0].m_algorithm,
              rig.cache().getOverlappingPairArray()[0].m_algorithm)
        << kind;
    EXPECT_EQ(rig.dispatcher.allocated, 2) << kind;
    world.removeCollisionObject(box.get());
    box.reset();
    EXPECT_EQ(ghost->getNumOverlappingObjects(), 0) << kind;
    EXPECT_EQ(rig.dispatcher.freed, 2) << kind;
    world.removeCollisionObject(ghost.get());
    ghost.reset();
    EXPECT_EQ(rig.dispatcher.getNumManifolds(), 0) << kind;
    rig.cache().setInternalGhostPairCallback(nullptr);
  }
}

}  // namespace
}  // namespace boxstream::bullet_test
