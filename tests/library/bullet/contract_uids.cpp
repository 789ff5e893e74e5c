// SPDX-License-Identifier: MIT
// Clauses I5 to I8 of the contract: unique ids.
#include <algorithm>
#include <set>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

TEST(BulletContract, I5_UidsUniqueConstantPositive) {
  Rig rig;
  Random random(5);
  std::vector<std::pair<btBroadphaseProxy*, int>> live;
  for (int op = 0; op < 3000; ++op) {
    if (live.empty() || random.below(3)) {
      btBroadphaseProxy* proxy = rig.create(cube(btScalar(random.below(20)), 0, 0));
      ASSERT_GE(proxy->m_uniqueId, 1);
      live.emplace_back(proxy, proxy->m_uniqueId);
    } else {
      const auto victim = live.begin() + random.below(static_cast<int>(live.size()));
      rig.destroy(victim->first);
      live.erase(victim);
    }
    if (op % 500 == 0) rig.calculate();
  }
  std::set<int> uids;
  for (const auto& [proxy, uid] : live) {
    EXPECT_EQ(proxy->m_uniqueId, uid);
    EXPECT_EQ(proxy->getUid(), uid);
    EXPECT_TRUE(uids.insert(uid).second) << uid;
  }
}

TEST(BulletContract, I6_UidsAsDbvtGivesThem) {
  Rig dbvt(Kind::dbvt), subject;
  Random random(6);
  std::vector<std::pair<btBroadphaseProxy*, btBroadphaseProxy*>> live;
  for (int op = 0; op < 4000; ++op) {
    const int what = random.below(10);
    if (what < 5) {
      const Box box = cube(btScalar(random.below(30)), btScalar(random.below(30)), 0);
      live.emplace_back(dbvt.create(box), subject.create(box));
      ASSERT_EQ(live.back().first->m_uniqueId, live.back().second->m_uniqueId) << "op " << op;
    } else if (what < 9 && !live.empty()) {
      const auto victim = live.begin() + random.below(static_cast<int>(live.size()));
      dbvt.destroy(victim->first);
      subject.destroy(victim->second);
      live.erase(victim);
    } else if (random.below(20) == 0) {
      for (const auto& [d, s] : live) {
        dbvt.destroy(d);
        subject.destroy(s);
      }
      live.clear();
      dbvt.broadphase->resetPool(&dbvt.dispatcher);
      subject.broadphase->resetPool(&subject.dispatcher);
    } else {
      dbvt.calculate();
      subject.calculate();
      dbvt.broadphase->resetPool(&dbvt.dispatcher);  // not empty, as a rule
      subject.broadphase->resetPool(&subject.dispatcher);
    }
  }
}

TEST(BulletContract, I6_NothingIsKeyedByAddress) {
  // The allocator gives the same address to a new proxy again and again; pairs of the old one must not come with it.
  Rig rig;
  btBroadphaseProxy* still = rig.create(cube(0, 0, 0));
  std::set<const void*> addresses;
  for (int i = 0; i < 200; ++i) {
    btBroadphaseProxy* proxy = rig.create(cube(0, 0, 0));
    addresses.insert(proxy);
    EXPECT_FALSE(rig.holds(still, proxy));
    rig.calculate();
    ASSERT_TRUE(rig.holds(still, proxy));
    EXPECT_EQ(find_in_array(*rig.broadphase, still, proxy)->m_algorithm, nullptr);
    rig.plant(still, proxy);
    rig.destroy(proxy);
    ASSERT_EQ(rig.algorithms_destroyed, i + 1);
    btBroadphaseProxy* far = rig.create(cube(50, 0, 0));
    rig.calculate();
    EXPECT_EQ(rig.pair_count(), 0);
    rig.destroy(far);
  }
  RecordProperty("distinct_addresses", static_cast<int>(addresses.size()));
}

TEST(BulletContract, I7_LowerUidGoesFirst) {
  for (const Kind kind : all_kinds) {
    Rig rig(kind);
    std::vector<btBroadphaseProxy*> proxies;
    for (int i = 0; i < 40; ++i) proxies.push_back(rig.create(cube(btScalar(10 * i), 0, 0)));
    for (int i = 39; i >= 0; --i)  // brought together in the other order
      rig.move(proxies[static_cast<std::size_t>(i)], cube(0, btScalar(i) / 50, 0));
    rig.calculate();
    const std::vector<UidPair> pairs = rig.pairs();
    EXPECT_EQ(pairs.size(), 780u) << kind;
    for (const auto& [first, second] : pairs) EXPECT_LT(first, second) << kind;
  }
}

TEST(BulletContract, I7_SavedFilesCarryTheUidsOfDbvt) {
  std::vector<int> saved[2];
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    Rig rig(kind);
    btCollisionWorld world(&rig.dispatcher, rig.broadphase.get(), &rig.config);
    btBoxShape shape(btVector3(1, 1, 1));
    std::deque<btCollisionObject> objects(12);
    for (btCollisionObject& object : objects) {
      object.setCollisionShape(&shape);
      world.addCollisionObject(&object, 3, 5);
    }
    world.refreshBroadphaseProxy(&objects[4]);
    world.removeCollisionObject(&objects[7]);
    btDefaultSerializer serializer;
    for (btCollisionObject& object : objects) {
      if (!object.getBroadphaseHandle()) continue;
      btCollisionObjectData data{};
      object.serialize(&data, &serializer);
      saved[kind == Kind::subject].push_back(data.m_uniqueId);
      EXPECT_EQ(data.m_collisionFilterGroup, 3);
      EXPECT_EQ(data.m_collisionFilterMask, 5);
    }
    for (btCollisionObject& object : objects)
      if (object.getBroadphaseHandle()) world.removeCollisionObject(&object);
  }
  EXPECT_EQ(saved[0].size(), 11u);
  EXPECT_EQ(saved[0], saved[1]);
}

TEST(BulletContract, I8_UidsBeyondSixteenBits) {
  auto* oracle = new Oracle(make_broadphase(Kind::subject));
  Rig rig;
  rig.broadphase.reset(oracle);
  btCollisionObject client;
  for (int i = 0; i < 70000; ++i) rig.destroy(rig.create_for(&client, cube(0, 0, 0)));
  Random random(8);
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 300; ++i) {
    const btVector3 p = random.vector(-4, 4);
    proxies.push_back(rig.create(cube(p.x(), p.y(), p.z())));
    ASSERT_GT(proxies.back()->m_uniqueId, 65535);
  }
  for (int frame = 0; frame < 10; ++frame) {
    for (btBroadphaseProxy* proxy : proxies) {
      const btVector3 p = random.vector(-4, 4);
      rig.move(proxy, cube(p.x(), p.y(), p.z()));
    }
    rig.calculate();
    ASSERT_TRUE(oracle->check(Rule::exact));
    for (const btBroadphasePair *pair = rig.cache().getOverlappingPairArrayPtr(), *end = pair + rig.pair_count();
         pair != end; ++pair)
      ASSERT_EQ(rig.cache().findPair(pair->m_pProxy1, pair->m_pProxy0), pair);
  }
}

}  // namespace
}  // namespace boxstream::bullet_test
