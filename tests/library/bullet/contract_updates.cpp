// SPDX-License-Identifier: MIT
// Section 2 of the contract: boxes that are set, batches, and what is read live.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <boxstream/bullet.hpp>

#include <deque>
#include <memory>
#include <vector>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

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

/// Where nothing else happens: a batch that has nothing to do looks at a few proxies.
TEST(BulletContract, I9_WritesAmidQuietAreNoticed) {
  for (const bool told : {false, true}) {
    Rig rig;
    auto* const broadphase = new boxstream::bullet::Broadphase;
    rig.broadphase.reset(broadphase);
    std::vector<btBroadphaseProxy*> pairs;
    for (int i = 0; i < 600; ++i) pairs.push_back(rig.create(cube(btScalar(10 * (i / 2)), 0, 0), 1, 2));
    for (int batch = 0; batch < 50; ++batch) rig.calculate();
    ASSERT_EQ(rig.pair_count(), 0);
    for (const std::size_t i : {400u, 401u}) pairs[i]->m_collisionFilterMask = 1;
    if (told) broadphase->refilter();
    for (int batch = 0; batch < (told ? 1 : 600 / 16 + 1); ++batch) rig.calculate();
    EXPECT_EQ(rig.pair_count(), 1);
    rig.move(pairs[0], cube(4000, 0, 0));
    rig.calculate();
    rig.destroy(pairs[400]);
    EXPECT_EQ(rig.pair_count(), 0);
    for (int batch = 0; batch < 3; ++batch) rig.calculate();
    broadphase->validate();
  }
}

/// By passes over all pairs, and by links after some of them.
TEST(BulletContract, P5_SomeDestroyedBetweenTwoBatches) {
  for (const int count : {1, 2, 5, 9, 30}) {
    Rig rig;
    std::vector<btBroadphaseProxy*> row;
    for (int i = 0; i < 60; ++i) row.push_back(rig.create(cube(btScalar(0.3) * btScalar(i), 0, 0)));
    rig.calculate();
    for (int i = 0; i < count; ++i) {
      btBroadphaseProxy* const gone = row[std::size_t(7 * i % 60)];
      btBroadphaseProxy* const other = row[std::size_t((7 * i + 1) % 60)];
      rig.cache().cleanProxyFromPairs(gone, &rig.dispatcher);
      if (i % 3 == 1) rig.cache().removeOverlappingPairsContainingProxy(other, &rig.dispatcher);
      if (i % 3 == 2) rig.cache().addOverlappingPair(gone, row[59]);
      rig.cache().removeOverlappingPairsContainingProxy(gone, &rig.dispatcher);
      const btBroadphasePair* const pairs = rig.pair_count() == 0 ? nullptr : rig.cache().getOverlappingPairArrayPtr();
      for (int p = 0; p < rig.pair_count(); ++p) EXPECT_TRUE(pairs[p].m_pProxy0 != gone && pairs[p].m_pProxy1 != gone);
      validate(*rig.broadphase);
    }
    rig.calculate();
    validate(*rig.broadphase);
    EXPECT_EQ(rig.pair_count(), 59 + 58 + 57) << "all come back";
  }
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

}  // namespace
}  // namespace boxstream::bullet_test
