// SPDX-License-Identifier: MIT
// What happens after 2^31 creations. The adapter is built once more here with the last id BOXSTREAM_BULLET_LAST_ID.
#include <boxstream/bullet.hpp>

#include <algorithm>
#include <map>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

using boxstream::bullet::Broadphase;
using boxstream::bullet::Eager;

constexpr int last_id = BOXSTREAM_BULLET_LAST_ID;

struct Setting {
  Eager eager;
  btOverlappingPairCache* cache;
};

/// Some thousand creations, hence many rounds of ids, with the oracle beside.
void live_through_many_rounds(const Setting& setting, unsigned seed) {
  boxstream::bullet::Options options;
  options.eager = setting.eager;
  options.exact_boxes = true;
  Rig rig;
  auto inner = std::make_unique<Broadphase>(setting.cache, options);
  const Broadphase& broadphase = *inner;
  auto* oracle = new Oracle(std::move(inner));
  rig.broadphase.reset(oracle);
  GhostLog log;
  if (!setting.cache) rig.cache().setInternalGhostPairCallback(&log);
  Random random(seed);
  std::vector<btBroadphaseProxy*> live;
  std::map<std::pair<const void*, const void*>, btCollisionAlgorithm*> planted;
  std::map<int, int> births;  // of the ids in use
  const auto place = [&] {
    const btVector3 p = random.vector(-3, 3);
    return cube(p.x(), p.y(), p.z());
  };
  for (int op = 0, created = 0; created < 12 * last_id; ++op) {
    const int what = random.below(20);
    if (live.size() < 10 || (what < 9 && live.size() < 60)) {
      btBroadphaseProxy* proxy = rig.create(place(), 1 << random.below(2), 1 + random.below(3));
      ++created;
      ASSERT_GE(proxy->m_uniqueId, 1);
      ASSERT_LE(proxy->m_uniqueId, last_id);
      ASSERT_TRUE(births.insert({proxy->m_uniqueId, created}).second) << "that of a live one";
      live.push_back(proxy);
      continue;
    }
    btBroadphaseProxy*& chosen = live[std::size_t(random.below(int(live.size())))];
    btBroadphaseProxy* const other = live[std::size_t(random.below(int(live.size())))];
    if (what < 14) {
      rig.move(chosen, place());
    } else if (what < 17) {
      births.erase(chosen->m_uniqueId);
      std::erase_if(planted,
                    [&](const auto& each) { return each.first.first == chosen || each.first.second == chosen; });
      rig.destroy(chosen);
      chosen = live.back();
      live.pop_back();
    } else if (what == 17 && chosen != other) {
      rig.cache().addOverlappingPair(chosen, other);  // gone at the next batch, if their boxes are apart
    } else if (what == 18 && chosen != other && !planted.count(std::minmax<const void*>(chosen, other))) {
      rig.cache().removeOverlappingPair(chosen, other, &rig.dispatcher);
    } else {
      rig.calculate();
      ASSERT_TRUE(oracle->check(Rule::exact)) << "op " << op;
      ASSERT_NO_THROW(broadphase.validate());
      if (!setting.cache) {
        std::vector<std::pair<int, int>> born;
        for (const auto& pair : rig.pairs()) born.push_back(std::minmax(births.at(pair.first), births.at(pair.second)));
        ASSERT_EQ(born, sorted(born)) << "op " << op;
      }
      for (auto it = planted.begin(); it != planted.end();) {
        const btBroadphasePair* const pair =
            find_in_array(*rig.broadphase, static_cast<const btBroadphaseProxy*>(it->first.first),
                          static_cast<const btBroadphaseProxy*>(it->first.second));
        if (pair) {
          ASSERT_EQ(pair->m_algorithm, it->second) << "of a pair that went on";
        }
        it = pair ? std::next(it) : planted.erase(it);
      }
      if (rig.pair_count() == 0) continue;
      const btBroadphasePair& pair = rig.cache().getOverlappingPairArrayPtr()[random.below(rig.pair_count())];
      const std::pair<const void*, const void*> name = std::minmax<const void*>({pair.m_pProxy0, pair.m_pProxy1});
      if (!pair.m_algorithm && setting.eager == Eager::none) planted[name] = rig.plant(pair.m_pProxy0, pair.m_pProxy1);
    }
  }
  for (btBroadphaseProxy* proxy : live) rig.destroy(proxy);
  EXPECT_EQ(rig.pair_count(), 0);
  EXPECT_TRUE(log.standing().empty());
  if (!setting.cache) rig.cache().setInternalGhostPairCallback(nullptr);
  rig.broadphase->resetPool(&rig.dispatcher);
  EXPECT_EQ(rig.create(cube(0, 0, 0))->m_uniqueId, 1);
}

TEST(BulletIdsUsedUp, I5_TheyComeUpAgainPastThoseInUse) {
  live_through_many_rounds({Eager::none, nullptr}, 1);
  live_through_many_rounds({Eager::all, nullptr}, 2);
}

TEST(BulletIdsUsedUp, I5_WithBorrowedCaches) {
  btHashedOverlappingPairCache hashed;
  live_through_many_rounds({Eager::none, &hashed}, 3);
}

TEST(BulletIdsUsedUp, I5_TheOldestKeepTheirs) {
  Rig rig;
  btBroadphaseProxy *first = rig.create(cube(0, 0, 0)), *third = nullptr, *latest = nullptr;
  rig.destroy(rig.create(cube(0, 0, 0)));
  third = rig.create(cube(0, 0, 0));
  while (!latest || latest->m_uniqueId != last_id) {
    if (latest) rig.destroy(latest);
    latest = rig.create(cube(0, 0, 0));
  }
  EXPECT_EQ(first->m_uniqueId, 1);
  EXPECT_EQ(rig.create(cube(0, 0, 0))->m_uniqueId, 2);
  EXPECT_EQ(third->m_uniqueId, 3);
  EXPECT_EQ(rig.create(cube(0, 0, 0))->m_uniqueId, 4);
  rig.calculate();
  const std::vector<UidPair> by_creation = {{1, 3}, {1, last_id}, {1, 2},       {1, 4},       {3, last_id},
                                            {2, 3}, {3, 4},       {2, last_id}, {4, last_id}, {2, 4}};
  EXPECT_EQ(rig.pairs(), by_creation);
}

/// A pair that a user made between two that are gone, and one that begins early between two with their ids.
TEST(BulletIdsUsedUp, I5_APairIsNotTakenForOneOfTheRoundBefore) {
  Rig rig;
  boxstream::bullet::Options options;
  options.eager = Eager::all;
  rig.broadphase = std::make_unique<Broadphase>(options);
  rig.create(cube(50, 0, 0));
  btBroadphaseProxy* const gone[] = {rig.create(cube(0, 0, 0)), rig.create(cube(9, 0, 0))};
  rig.cache().addOverlappingPair(gone[0], gone[1]);
  rig.destroy(gone[0]);
  rig.destroy(gone[1]);
  for (int id = 4; id <= last_id; ++id) rig.destroy(rig.create(cube(70, 0, 0)));
  btBroadphaseProxy* const a = rig.create(cube(0, 0, 0));
  btBroadphaseProxy* const b = rig.create(cube(0, 0, 0));
  ASSERT_EQ(a->m_uniqueId, 2);
  ASSERT_EQ(b->m_uniqueId, 3);
  EXPECT_TRUE(rig.holds(a, b));
  rig.calculate();
  EXPECT_TRUE(rig.holds(a, b));
}

TEST(BulletIdsUsedUpDeathTest, MoreAtOnceThanIdsIsTheEnd) {
  Rig rig;
  for (int i = 0; i < last_id; ++i) rig.create(cube(btScalar(3 * i), 0, 0));
  EXPECT_DEATH(rig.create(cube(0, 0, 0)), "^boxstream::bullet: too many proxies or pairs\n$");
}

}  // namespace
}  // namespace boxstream::bullet_test
