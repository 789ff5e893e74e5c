// SPDX-License-Identifier: MIT
// Callbacks that throw at each of their calls: the next batch is right.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <gtest/gtest.h>
#include <boxstream/bullet.hpp>

#include <memory>

#include "watched.hpp"

namespace boxstream::bullet_test {
namespace {

struct Thrown {};

/// Throws at one call of a callback, counted from 1.
struct Fuse {
  void burn() {
    if (++calls == at) throw Thrown();
  }
  int at = 0;
  int calls = 0;
};

/// Twenty at one place, of which ten came there since the last batch.
std::vector<btBroadphaseProxy*> make_crowd(Rig& rig) {
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 20; ++i) proxies.push_back(rig.create(cube(i < 10 ? 0 : btScalar(5 * i), 0, 0)));
  rig.calculate();
  for (std::size_t i = 10; i < 20; ++i) rig.move(proxies[i], cube(0, 0, 0));
  rig.move(proxies[0], cube(50, 0, 0));
  return proxies;
}

/// A filter that throws leaves the pairs of the last batch, and the next batch is right.
TEST(BulletHardBoxes, FilterThrowsAtEachPair) {
  for (int at = 1;; ++at) {
    Watched watched;
    Fuse fuse{at};
    FunctionFilter filter([&](auto, auto) {
      fuse.burn();
      return true;
    });
    make_crowd(watched.rig);
    const auto before = watched.rig.pairs();
    watched.rig.cache().setOverlapFilterCallback(&filter);
    bool threw = false;
    try {
      watched.oracle->inner().calculateOverlappingPairs(&watched.rig.dispatcher);  // for the oracle asks filters too
    } catch (const Thrown&) {
      threw = true;
    }
    watched.rig.cache().setOverlapFilterCallback(nullptr);
    if (!threw) {
      EXPECT_GT(at, 100) << "nothing was put to the test";
      return;
    }
    ASSERT_EQ(watched.rig.pairs(), before) << "call " << at;
    ASSERT_NO_THROW(validate(watched.oracle->inner()));
    ASSERT_TRUE(watched.calculate()) << "call " << at;
  }
}

/// The same where pairs begin as soon as boxes change: none may be lost between the World and the cache.
TEST(BulletHardBoxes, FilterThrowsAtEachEagerPair) {
  for (int at = 1; at <= 19; ++at) {
    boxstream::bullet::Options options;
    options.eager = boxstream::bullet::Eager::all;
    auto* oracle = new Oracle(std::make_unique<boxstream::bullet::Broadphase>(options));
    Rig rig;
    rig.broadphase.reset(oracle);
    for (int i = 0; i < 20; ++i) rig.create(cube(0, 0, 0));
    btBroadphaseProxy* const mover = rig.create(cube(9, 0, 0));
    Fuse fuse{at};
    FunctionFilter filter([&](auto, auto) {
      fuse.burn();
      return true;
    });
    rig.cache().setOverlapFilterCallback(&filter);
    EXPECT_THROW(rig.move(mover, cube(0, 0, 0)), Thrown);
    rig.cache().setOverlapFilterCallback(nullptr);
    ASSERT_NO_THROW(validate(oracle->inner())) << "call " << at;
    rig.calculate();
    ASSERT_TRUE(oracle->check(Rule::exact)) << "call " << at;
    ASSERT_NO_THROW(validate(oracle->inner())) << "call " << at;
  }
}

/// A ghost callback that throws is told the rest with the next batch: in the end it has heard of every pair once.
TEST(BulletHardBoxes, GhostCallbackThrowsAtEachEvent) {
  for (int at = 1;; ++at) {
    Watched watched;
    Fuse fuse;
    GhostLog ghost;
    ghost.on_event = [&](const GhostLog::Event&) { fuse.burn(); };
    watched.rig.cache().setInternalGhostPairCallback(&ghost);
    const auto proxies = make_crowd(watched.rig);
    fuse = {at, 0};
    bool threw = false;
    try {
      watched.rig.calculate();
    } catch (const Thrown&) {
      threw = true;
    }
    fuse = {};
    if (threw && at % 2 == 0) {  // between the batch that threw and the next
      watched.rig.destroy(proxies[7]);
      ASSERT_EQ(ghost.standing(), sorted(watched.rig.pairs())) << "event " << at;
    }
    if (threw) {
      watched.rig.move(proxies[3], cube(90, 0, 0));  // whose pairs may be among those not told of yet
      ASSERT_TRUE(watched.calculate()) << "event " << at;
    }
    ASSERT_EQ(ghost.standing(), sorted(watched.rig.pairs())) << "event " << at;
    watched.rig.destroy(proxies[5]);
    ASSERT_EQ(ghost.standing(), sorted(watched.rig.pairs())) << "event " << at;
    watched.rig.cache().setInternalGhostPairCallback(nullptr);
    if (!threw) {
      EXPECT_GT(at, 100) << "nothing was put to the test";
      return;
    }
  }
}

/// The same twice: in a batch, and then within a move, where what is left of the batch is told first.
TEST(BulletHardBoxes, GhostCallbackThrowsInABatchAndInAMove) {
  for (int at = 1; at <= 30; ++at) {
    boxstream::bullet::Options options;
    options.eager = boxstream::bullet::Eager::all;
    auto* oracle = new Oracle(std::make_unique<boxstream::bullet::Broadphase>(options));
    Rig rig;
    rig.broadphase.reset(oracle);
    Fuse fuse;
    GhostLog ghost;
    ghost.on_event = [&](const GhostLog::Event&) { fuse.burn(); };
    rig.cache().setInternalGhostPairCallback(&ghost);
    const auto proxies = make_crowd(rig);
    const auto throws = [&](auto&& call) {
      fuse = {at, 0};
      try {
        call();
      } catch (const Thrown&) {
        return true;
      }
      return false;
    };
    for (std::size_t i = 0; i < 10; ++i) rig.move(proxies[i], cube(60, btScalar(5 * i), 0));
    EXPECT_TRUE(throws([&] { rig.calculate(); })) << "call " << at;
    EXPECT_TRUE(throws([&] { rig.move(proxies[1], cube(0, 0, 0)); })) << "call " << at;
    EXPECT_TRUE(throws([&] { rig.move(proxies[2], cube(0, 0, 0)); })) << "call " << at;
    fuse = {};
    rig.calculate();
    ASSERT_TRUE(oracle->check(Rule::exact)) << "call " << at;
    ASSERT_NO_THROW(validate(oracle->inner())) << "call " << at;
    ASSERT_EQ(ghost.standing(), sorted(rig.pairs())) << "call " << at;
    rig.cache().setInternalGhostPairCallback(nullptr);
  }
}

/// And in two batches, the second of which rooms would answer.
TEST(BulletHardBoxes, GhostCallbackThrowsInTwoBatches) {
  for (int at = 1; at <= 4; ++at) {
    Watched watched;
    Fuse fuse;
    GhostLog ghost;
    ghost.on_event = [&](const GhostLog::Event&) { fuse.burn(); };
    watched.rig.cache().setInternalGhostPairCallback(&ghost);
    std::vector<btBroadphaseProxy*> proxies;
    for (int i = 0; i < 60; ++i) proxies.push_back(watched.rig.create(cube(btScalar(1.05) * btScalar(i), 0, 0)));
    Random random(3);
    const auto tremble = [&] {
      for (int i = 2; i < 60; ++i)
        watched.rig.move(proxies[std::size_t(i)],
                         cube(btScalar(1.05) * btScalar(i) + random.real(btScalar(-0.001), btScalar(0.001)), 0, 0));
    };
    for (int batch = 0; batch < 40; ++batch) {
      tremble();
      ASSERT_TRUE(watched.calculate());
    }
    int thrown = 0;
    for (int batch = 0; batch < 2; ++batch) {
      for (std::size_t i = 0; i < 2; ++i)
        watched.rig.move(proxies[i], cube(btScalar(20 + 10 * batch) + btScalar(i), btScalar(0.4), 0));
      fuse = {at, 0};
      try {
        watched.oracle->inner().calculateOverlappingPairs(&watched.rig.dispatcher);
      } catch (const Thrown&) {
        ++thrown;
      }
    }
    fuse = {};
    EXPECT_GT(thrown, 0) << "event " << at;
    ASSERT_TRUE(watched.calculate()) << "event " << at;
    ASSERT_NO_THROW(validate(watched.oracle->inner())) << "event " << at;
    ASSERT_EQ(ghost.standing(), sorted(watched.rig.pairs())) << "event " << at;
    watched.rig.cache().setInternalGhostPairCallback(nullptr);
  }
}

/// Once a filter was set, all that the one before refused is asked about, although the first batch throws and only a
/// ghost moves after it.
TEST(BulletHardBoxes, FilterThrowsWhereOnlyGhostsMove) {
  Rig rig;
  auto* const broadphase = new boxstream::bullet::Broadphase;
  rig.broadphase.reset(broadphase);
  btGhostPairCallback ghosts;
  rig.cache().setInternalGhostPairCallback(&ghosts);
  btPairCachingGhostObject ghost;
  btBroadphaseProxy *const a = rig.create(cube(0, 0, 0)), *const b = rig.create(cube(btScalar(0.5), 0, 0));
  for (int i = 0; i < 18; ++i) rig.create(cube(btScalar(10 * i + 10), 0, 0));
  btBroadphaseProxy* const moving = rig.create_for(&ghost, cube(0, 100, 0));
  FunctionFilter refuse([&](auto* x, auto* y) { return !((x == a && y == b) || (x == b && y == a)); });
  rig.cache().setOverlapFilterCallback(&refuse);
  for (int i = 0; i < 60; ++i) {
    rig.move(moving, cube(0, btScalar(100 + i), 0));
    rig.calculate();
  }
  EXPECT_FALSE(rig.holds(a, b));
  Fuse fuse{1};
  FunctionFilter accept([&](auto, auto) {
    fuse.burn();
    return true;
  });
  rig.cache().setOverlapFilterCallback(&accept);
  rig.move(moving, cube(0, 200, 0));
  EXPECT_THROW(rig.calculate(), Thrown);
  rig.move(moving, cube(0, 201, 0));
  rig.calculate();
  EXPECT_TRUE(rig.holds(a, b));
  validate(*rig.broadphase);
  rig.destroy(moving);
  rig.cache().setOverlapFilterCallback(nullptr);
  rig.cache().setInternalGhostPairCallback(nullptr);
}

TEST(BulletHardBoxes, QueriesThrowAtEachProxy) {
  Rig rig;
  make_crowd(rig);
  const auto expected = rig.in_box(cube(0, 0, 0));
  ASSERT_EQ(expected.size(), 19u);
  for (int at = 1; at <= 19; ++at) {
    Fuse fuse{at};
    Found found;
    found.also = [&](const btBroadphaseProxy*) { fuse.burn(); };
    const Box box = cube(0, 0, 0);
    EXPECT_THROW(rig.broadphase->aabbTest(box.lo, box.hi, found), Thrown);
    EXPECT_EQ(found.proxies.size(), static_cast<std::size_t>(at));
    fuse = {at, 0};
    FoundOnRay hit(btVector3(-9, 0, 0), btVector3(9, 0, 0));
    hit.also = found.also;
    EXPECT_THROW(rig.broadphase->rayTest(btVector3(-9, 0, 0), btVector3(9, 0, 0), hit), Thrown);
    EXPECT_EQ(hit.proxies.size(), static_cast<std::size_t>(at));
    ASSERT_EQ(rig.in_box(cube(0, 0, 0)), expected) << "a query after one that threw";
  }
}

}  // namespace
}  // namespace boxstream::bullet_test
