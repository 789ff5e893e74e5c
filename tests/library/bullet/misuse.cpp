// SPDX-License-Identifier: MIT
// What callers should not do, and do: debug builds assert, release builds stay whole.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <utility>

#include <boxstream/bullet.hpp>

#include "oracle.hpp"
#include "watched.hpp"

namespace boxstream::bullet_test {
namespace {

using boxstream::bullet::Broadphase;
using boxstream::bullet::Options;

#ifdef NDEBUG

/// The filter destroys a proxy while pairs are being found, in an own cache and in a borrowed one.
TEST(BulletMisuse, FilterDestroysProxies) {
  for (const bool borrowed : {false, true})
    for (int at = 1; at <= 40; ++at) {
      btHashedOverlappingPairCache cache;
      Rig rig(Kind::subject, borrowed ? &cache : nullptr);
      std::vector<btBroadphaseProxy*> crowd;
      for (int i = 0; i < 10; ++i) crowd.push_back(rig.create(cube(btScalar(i) / 16, 0, 0)));
      int calls = 0;
      FunctionFilter filter([&](auto, auto) {
        if (++calls == at) {
          rig.destroy(crowd[3]);
          rig.broadphase->resetPool(&rig.dispatcher);
          rig.calculate();
        }
        return true;
      });
      rig.cache().setOverlapFilterCallback(&filter);
      rig.calculate();
      rig.cache().setOverlapFilterCallback(nullptr);
      rig.calculate();
      ASSERT_EQ(rig.pair_count(), calls >= at ? 36 : 45) << (borrowed ? "borrowed" : "own") << " cache, call " << at;
      ASSERT_NO_THROW(validate(*rig.broadphase));
    }
}

/// The same, and a pair that it removes, while boxes tremble in their rooms and say themselves what begins: a pair in
/// the middle of all, and the last one.
TEST(BulletMisuse, FilterChangesASettledPile) {
  for (const bool destroys : {true, false})
    for (const std::size_t beside : {2, 28}) {
      Rig rig;
      Random random(17);
      std::vector<btVector3> places;
      for (int i = 0; i < 27; ++i) places.emplace_back(btScalar(0.9) * btVector3(i % 3, i / 3 % 3, i / 9));
      places.insert(places.begin() + 3, btVector3(btScalar(2.85), 0, 0));  // 0.05 from the third one
      places.emplace_back(20, 0, 0);
      places.emplace_back(btScalar(21.05), 0, 0);
      std::vector<btBroadphaseProxy*> proxies;
      const auto place = [](const btVector3& at) { return cube(at.x(), at.y(), at.z()); };
      for (const btVector3& at : places) proxies.push_back(rig.create(place(at)));
      bool changes = false;
      FunctionFilter filter([&](auto, auto) {
        if (std::exchange(changes, false)) {
          if (destroys)
            rig.destroy(proxies[12]);
          else
            rig.cache().removeOverlappingPair(proxies[0], proxies[1], &rig.dispatcher);
        }
        return true;
      });
      rig.cache().setOverlapFilterCallback(&filter);
      const auto tremble = [&] {
        for (std::size_t i = 0; i < places.size(); ++i)
          rig.move(proxies[i], place(places[i] + random.vector(btScalar(-0.001), btScalar(0.001))));
        rig.calculate();
      };
      for (int frame = 0; frame < 40; ++frame) tremble();
      ASSERT_EQ(static_cast<Broadphase&>(*rig.broadphase).stats().moved, 0u) << "no rooms";
      changes = true;
      places[beside + 1] -= btVector3(btScalar(0.07), 0, 0);
      tremble();
      ASSERT_FALSE(changes) << "no pair began";
      ASSERT_TRUE(rig.holds(proxies[beside], proxies[beside + 1]));
      for (int frame = 0; frame < 3; ++frame) {
        rig.calculate();
        ASSERT_NO_THROW(validate(*rig.broadphase));
      }
      if (destroys) proxies.erase(proxies.begin() + 12);
      int touching = 0;
      for (const btBroadphaseProxy* a : proxies)
        for (const btBroadphaseProxy* b : proxies)
          touching += a < b && boxes_overlap(a->m_aabbMin, a->m_aabbMax, b->m_aabbMin, b->m_aabbMax);
      EXPECT_EQ(rig.pair_count(), touching);
    }
}

/// A ghost callback destroys a proxy whose other pairs still wait to be told.
TEST(BulletMisuse, GhostCallbackDestroysProxies) {
  for (const bool ending : {false, true})
    for (int at = 1; at <= 30; ++at) {
      Rig rig;
      std::vector<btBroadphaseProxy*> crowd;
      for (int i = 0; i < 10; ++i) crowd.push_back(rig.create(cube(btScalar(i) / 16, 0, 0)));
      if (ending) {
        rig.calculate();
        for (int i = 0; i < 10; ++i) rig.move(crowd[static_cast<std::size_t>(i)], cube(btScalar(10 * i), 0, 0));
      }
      GhostLog log;
      int calls = 0;
      log.on_event = [&](const GhostLog::Event&) {
        if (++calls == at) rig.destroy(crowd[3]);
      };
      rig.cache().setInternalGhostPairCallback(&log);
      rig.calculate();
      rig.cache().setInternalGhostPairCallback(nullptr);
      ASSERT_GE(calls, at);
      rig.calculate();
      ASSERT_EQ(rig.pair_count(), ending ? 0 : 36) << at;
      ASSERT_NO_THROW(validate(*rig.broadphase));
    }
}

#endif

struct RemovesBehindTheBack : btOverlapCallback {
  explicit RemovesBehindTheBack(Rig& rig) : rig_(rig) {}
  bool processOverlap(btBroadphasePair& pair) override {
    ++calls;
    btBroadphaseProxy* const a = pair.m_pProxy0;
    rig_.cache().removeOverlappingPairsContainingProxy(a, &rig_.dispatcher);
    return true;
  }
  int calls = 0;

 private:
  Rig& rig_;
};

TEST(BulletMisuse, VisitorRemovesPairsItself) {
  for (const bool deterministic : {false, true}) {
    Rig rig;
    for (int i = 0; i < 10; ++i) rig.create(cube(btScalar(i) / 16, 0, 0));
    rig.calculate();
    ASSERT_EQ(rig.pair_count(), 45);
    RemovesBehindTheBack visitor(rig);
    btDispatcherInfo info;
    info.m_deterministicOverlappingPairs = deterministic;
    rig.cache().processAllOverlappingPairs(&visitor, &rig.dispatcher, info);
    EXPECT_EQ(rig.pair_count(), 0);
    EXPECT_GE(visitor.calls, 1);
    EXPECT_NO_THROW(validate(*rig.broadphase)) << "with pairs that were removed and not yet made again";
    rig.calculate();
    rig.calculate();
    EXPECT_EQ(rig.pair_count(), 45);
  }
}

/// A borrowed cache whose answers say less than they should.
class SilentCache : public btHashedOverlappingPairCache {
 public:
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override {
    btHashedOverlappingPairCache::addOverlappingPair(a, b);
    return nullptr;
  }
};

TEST(BulletMisuse, BorrowedCacheHidesWhatItAdded) {
  SilentCache cache;
  Watched watched(&cache);
  watched.create({{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}, {{5, 5, 5}, {6, 6, 6}}});
  ASSERT_TRUE(watched.calculate());
  EXPECT_EQ(watched.rig.pair_count(), 1);
}

/// Users change a sorted cache, which cleans up late, between batches.
TEST(BulletMisuse, SortedCacheIsChangedBehindTheBack) {
  btSortedOverlappingPairCache cache;
  Watched watched(&cache);
  Rig& rig = watched.rig;
  std::vector<btBroadphaseProxy*> row;
  for (int i = 0; i < 8; ++i) row.push_back(rig.create(cube(btScalar(i) / 2, 0, 0)));
  ASSERT_TRUE(watched.calculate());
  const int before = rig.pair_count();
  cache.addOverlappingPair(row[0], row[7]);
  cache.addOverlappingPair(row[0], row[1]);  // twice now: a sorted cache does not look
  ASSERT_TRUE(watched.calculate());
  EXPECT_EQ(rig.pair_count(), before);
  cache.getOverlappingPairArray().pop_back();
  rig.destroy(row[2]);
  rig.broadphase->calculateOverlappingPairs(nullptr);
  EXPECT_TRUE(watched.oracle->check(Rule::exact));
}

TEST(BulletMisuse, ForeignClientsAndBadMargins) {
  // An odd number above what callers use as indices, and not the address of any object.
  Rig rig;
  btBroadphaseProxy* const odd = rig.create_for(reinterpret_cast<btCollisionObject*>(0x1234567), cube(0, 0, 0));
  btBroadphaseProxy* const plain = rig.create(cube(9, 0, 0));
  rig.move(plain, cube(0, 0, 0));
  EXPECT_EQ(rig.pair_count(), 0);
  rig.calculate();
  EXPECT_TRUE(rig.holds(odd, plain));
  EXPECT_EQ(rig.cache().addOverlappingPair(odd, odd), nullptr);

  for (const btScalar margin : {btScalar(-1), std::numeric_limits<btScalar>::quiet_NaN()}) {
    Options options;
    options.margin = margin;
    rig.broadphase = std::make_unique<Broadphase>(options);
    btBroadphaseProxy* const a = rig.create(cube(0, 0, 0));
    btBroadphaseProxy* const b = rig.create(cube(1, 0, 0));
    rig.calculate();
    EXPECT_TRUE(rig.holds(a, b)) << "as without a margin";
  }
  Options options;
  options.margin = btScalar(0.1);
  rig.broadphase = std::make_unique<Broadphase>(options);
  btBroadphaseProxy* const bad = rig.create({btVector3(1, 1, 1), btVector3(-1, -1, -1)});
  btBroadphaseProxy* const good = rig.create(cube(0, 0, 0));
  rig.calculate();
  EXPECT_FALSE(rig.holds(bad, good)) << "a margin must not turn a box the right way round";
}

TEST(BulletMisuse, QueriesOfInvalidThings) {
  Rig rig;
  auto* const broadphase = dynamic_cast<Broadphase*>(rig.broadphase.get());
  ASSERT_NE(broadphase, nullptr);
  btBroadphaseProxy* const good = rig.create(cube(0, 0, 0));
  btBroadphaseProxy* const other = rig.create(cube(3, 0, 0));
  rig.create({btVector3(1, 1, 1), btVector3(-1, -1, -1)});
  const btVector3 up(0, 1, 0);
  const btScalar offset = 100;
  Found found;
  found.also = [&](const btBroadphaseProxy* proxy) {
    if (proxy == good) rig.destroy(other);
  };
  broadphase->planesTest(&up, &offset, 1, found);
  EXPECT_EQ(found.proxies, std::vector<const btBroadphaseProxy*>{good}) << "one was destroyed before its turn";

  FoundOnRay ray(btVector3(-5, 0, 0), btVector3(5, 0, 0));
  ray.m_lambda_max = std::numeric_limits<btScalar>::quiet_NaN();
  rig.broadphase->rayTest(btVector3(-5, 0, 0), btVector3(5, 0, 0), ray);
  EXPECT_TRUE(ray.proxies.empty());
}

/// A pair that a user made, and that then begins early all the same, is the broad-phase's from then on.
TEST(BulletMisuse, UserMakesAPairThatBeginsEarly) {
  Rig rig;
  Options options;
  options.eager = boxstream::bullet::Eager::all;
  rig.broadphase = std::make_unique<Broadphase>(options);
  GhostLog log;
  rig.cache().setInternalGhostPairCallback(&log);
  btBroadphaseProxy* const a = rig.create(cube(0, 0, 0));
  btBroadphaseProxy* const b = rig.create(cube(9, 0, 0));
  rig.cache().addOverlappingPair(a, b);
  rig.move(b, cube(0, 0, 0));
  EXPECT_EQ(rig.pair_count(), 1);
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 1);
  rig.move(b, cube(9, 0, 0));
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 0);
  EXPECT_TRUE(log.standing().empty());
  EXPECT_EQ(log.adds(), 1);
  rig.cache().setInternalGhostPairCallback(nullptr);
}

TEST(BulletMisuse, EmptyOwnCacheAnswers) {
  Rig rig;
  btOverlappingPairCache& cache = rig.cache();
  EXPECT_EQ(cache.getOverlappingPairArrayPtr(), nullptr);
  EXPECT_FALSE(cache.hasDeferredRemoval());
  cache.sortOverlappingPairs(&rig.dispatcher);
  EXPECT_EQ(rig.pair_count(), 0);
}

/// The order is made again after removals from the middle.
TEST(BulletMisuse, SortsWhenAsked) {
  Rig rig;
  std::vector<btBroadphaseProxy*> row;
  for (int i = 0; i < 50; ++i) row.push_back(rig.create(cube(btScalar(i) / 4, 0, 0)));
  rig.calculate();
  for (std::size_t i = 0; i < 50; i += 5) rig.destroy(row[i]);
  EXPECT_NE(rig.pairs(), sorted(rig.pairs())) << "removals take the last pair to the free place";
  rig.cache().sortOverlappingPairs(&rig.dispatcher);
  EXPECT_EQ(rig.pairs(), sorted(rig.pairs()));
}

}  // namespace
}  // namespace boxstream::bullet_test
