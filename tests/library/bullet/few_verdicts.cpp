// SPDX-License-Identifier: MIT
// Clauses P1 and P2 where there are so few proxies that verdicts about them are kept as bits.
#include <boxstream/bullet.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include <BulletCollision/CollisionDispatch/btGhostObject.h>

#include "oracle.hpp"
#include "pile.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

/// A few change in each frame: they tremble, go far, come, go, become invalid, a user removes a pair or adds one, or
/// the World has to know.
void live_on(Pile& pile, Random& random, int frame, btScalar reach = 2) {
  for (int times = random.below(4); times > 0 && !pile.proxies.empty(); --times) {
    const auto one = std::size_t(random.below(int(pile.proxies.size())));
    pile.set(one, pile.places[one] += random.vector(btScalar(-0.02), btScalar(0.02)));
  }
  if (frame % 7 != 3 || pile.proxies.empty()) return;
  const auto one = std::size_t(random.below(int(pile.proxies.size())));
  btOverlappingPairCache& cache = *pile.broadphase.getOverlappingPairCache();
  switch (random.below(10)) {
    case 0:
      return pile.add(random.vector(-reach, reach));
    case 1:
      return pile.remove(one);
    case 2:
      return pile.set(one, pile.places[one] = random.vector(-reach, reach));
    case 3:
      return pile.broadphase.setAabb(pile.proxies[one], btVector3(1, 1, 1), btVector3(-1, 1, 1), nullptr);
    case 4:
      pile.remove(one);
      return pile.add(random.vector(-reach, reach));
    case 5:
      while (!pile.proxies.empty() && random.below(6) != 0)
        pile.remove(std::size_t(random.below(int(pile.proxies.size()))));
      while (random.below(6) != 0) pile.add(random.vector(-reach, reach));
      return;
    case 6: {
      const auto other = std::size_t(random.below(int(pile.proxies.size())));
      cache.addOverlappingPair(pile.proxies[one], pile.proxies[other]);
      return;
    }
    case 7: {
      static FunctionFilter all([](btBroadphaseProxy*, btBroadphaseProxy*) { return true; });
      return cache.setOverlapFilterCallback(cache.getOverlapFilterCallback() == nullptr ? &all : nullptr);
    }
    case 8: {
      FoundOnRay found(btVector3(-9, 0, 0), btVector3(9, 0, 0));
      return pile.broadphase.rayTest(btVector3(-9, 0, 0), btVector3(9, 0, 0), found);
    }
    default: {
      if (cache.getNumOverlappingPairs() == 0) return;
      const btBroadphasePair pair = cache.getOverlappingPairArrayPtr()[cache.getNumOverlappingPairs() / 2];
      cache.removeOverlappingPair(pair.m_pProxy0, pair.m_pProxy1, nullptr);
      if (random.below(2) == 0) pile.remove(one);  // which tells the World of the user's change
    }
  }
}

/// Sorted, of boxes that are larger by the margin.
std::vector<UidPair> expected(const Pile& pile, btScalar margin) {
  const btVector3 more(margin, margin, margin);
  std::vector<UidPair> pairs;
  for (const btBroadphaseProxy* a : pile.proxies)
    for (const btBroadphaseProxy* b : pile.proxies)
      if (a->m_uniqueId < b->m_uniqueId && is_valid_box(a->m_aabbMin, a->m_aabbMax) &&
          is_valid_box(b->m_aabbMin, b->m_aabbMax) &&
          boxes_overlap(a->m_aabbMin - more, a->m_aabbMax + more, b->m_aabbMin - more, b->m_aabbMax + more))
        pairs.emplace_back(a->m_uniqueId, b->m_uniqueId);
  return sorted(pairs);
}

TEST(BulletFewVerdicts, PairsAreThoseThatTouch) {
  for (const btScalar margin : {btScalar(0), btScalar(0.0625)})
    for (const int more : {-7, -4, 0, 4, 13, 22, 24, 27}) {
      bullet::Options options;
      options.margin = margin;
      Pile pile(options, 2, std::uint64_t(8 + more));
      Random random(17);
      for (int i = 0; i < more; ++i) pile.add(random.vector(-2, 2));
      for (int i = 0; i > more; --i) pile.remove(0);
      for (int frame = 0; frame < 2000; ++frame) {
        live_on(pile, random, frame);
        if (random.below(5) == 0) continue;  // several changes before a batch
        pile.calculate();
        ASSERT_EQ(pairs_of(pile.broadphase), expected(pile, margin)) << margin << ", " << more << ", frame " << frame;
        ASSERT_NO_THROW(pile.broadphase.validate()) << frame;
      }
    }
}

/// Of more than very few, where few change in a batch, up to as many as verdicts are for, and beyond.
TEST(BulletFewVerdicts, PairsOfMoreAreThoseThatTouch) {
  for (const int size : {40, 64, 97, 127, 160, 250, 318}) {
    Pile pile({}, 2, std::uint64_t(size));
    Random random{std::uint64_t(size)};
    const btScalar reach = size < 128 ? 3 : 5;
    while (pile.proxies.size() < std::size_t(size)) pile.add(random.vector(-reach, reach));
    for (int frame = 0; frame < 700; ++frame) {
      live_on(pile, random, frame, reach);
      if (random.below(5) == 0) continue;
      pile.calculate();
      ASSERT_EQ(pairs_of(pile.broadphase), expected(pile, 0)) << size << ", frame " << frame;
      ASSERT_NO_THROW(pile.broadphase.validate()) << size << ", frame " << frame;
    }
  }
}

/// A box leaves its room, and rooms are closed before the batch, at any time after boxes have become calm.
TEST(BulletFewVerdicts, BoxesThatHaveLeftRoomsAreLookedAt) {
  int with_rooms = 0;
  for (int wild = 0; wild < 60; ++wild) {
    Pile pile({}, 2);
    for (int frame = 0; frame < wild; ++frame) {
      pile.tremble(btScalar(0.05));
      pile.calculate();
    }
    for (int frame = 0; frame < 60 && (frame < 10 || pile.broadphase.stats().moved != 0); ++frame) {
      pile.tremble();
      pile.calculate();
    }
    with_rooms += pile.broadphase.stats().moved == 0;
    pile.set(0, pile.places[7] + btVector3(0, 0, btScalar(0.125)));
    pile.add(btVector3(50, 0, 0));
    pile.calculate();
    pile.check("gone to another", wild);
  }
  EXPECT_GT(with_rooms, 10);
}

/// The array, and what ghosts hear, are those of a World, in the same order.
TEST(BulletFewVerdicts, OrderIsThatOfMany) {
  constexpr int more = 60;  // far away, between the first proxy and the rest
  Pile few({}, 1), many({}, 1);
  for (int i = 0; i < more; ++i) many.add(btVector3(btScalar(100 + 3 * i), 0, 0));
  GhostLog of_few, of_many;
  few.broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&of_few);
  many.broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&of_many);
  const auto events_of = [](const GhostLog& log, int added) {
    std::vector<std::tuple<bool, int, int>> events;
    const auto number = [added](int uid) { return uid == 1 ? uid : uid - added; };
    for (const GhostLog::Event& event : log.events)
      events.emplace_back(event.add, number(event.uid0), number(event.uid1));
    return events;
  };
  const auto array_of = [](Pile& pile, int added) {
    std::vector<UidPair> pairs;
    const auto number = [added](const btBroadphaseProxy* proxy) {
      return proxy->m_uniqueId == 1 ? 1 : proxy->m_uniqueId - added;
    };
    const btBroadphasePairArray& array = pile.broadphase.getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < array.size(); ++i) pairs.emplace_back(number(array[i].m_pProxy0), number(array[i].m_pProxy1));
    return pairs;
  };
  Random random(5);
  for (int frame = 0; frame < 300; ++frame) {
    for (int times = random.below(4); times > 0; --times) {
      const auto one = std::size_t(random.below(int(few.proxies.size())));
      const btVector3 place = random.vector(-1, 1);
      const int what = random.below(3);
      if (what == 0 && few.proxies.size() < 24) {
        few.add(place);
        many.add(place);
      } else if (what == 1 && few.proxies.size() > 3) {
        few.remove(one);
        many.remove(one == 0 && many.proxies[0]->m_uniqueId == 1 ? 0 : one + more);
      } else if (what == 2) {
        few.set(one, place);
        many.set(one == 0 && many.proxies[0]->m_uniqueId == 1 ? 0 : one + more, place);
      }
    }
    few.calculate();
    many.calculate();
    ASSERT_EQ(array_of(few, 0), array_of(many, more)) << frame;
    ASSERT_EQ(events_of(of_few, 0), events_of(of_many, more)) << frame;
  }
  EXPECT_GT(of_few.events.size(), 300u);
  few.broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(nullptr);
  many.broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(nullptr);
}

/// With a ghost, for a proxy to be created for, and its callback.
struct GhostRig : Rig {
  GhostRig() { cache().setInternalGhostPairCallback(&log); }
  ~GhostRig() { cache().setInternalGhostPairCallback(nullptr); }

  GhostLog log;
  btGhostObject ghost;
};

/// Others come to a ghost in a batch, then it asks for its pairs itself.
TEST(BulletFewVerdicts, GhostsHearOfEachPairOnce) {
  GhostRig rig;
  btBroadphaseProxy* const at_ghost = rig.create_for(&rig.ghost, cube(0, 0, 0));
  btBroadphaseProxy* const at_box = rig.create(cube(5, 0, 0));
  for (int frame = 0; frame < 20; ++frame) {
    rig.move(at_box, cube(frame % 4 < 2 ? btScalar(0.5) : 5, 0, 0));
    rig.calculate();
    rig.move(at_ghost, cube(0, btScalar(0.01) * btScalar(frame % 3), 0));
    EXPECT_EQ(rig.pair_count(), frame % 4 < 2 ? 1 : 0) << frame;
  }
  EXPECT_EQ(rig.log.adds(), 5);
}

/// As a ghost asks, the World hears of a pair that a batch has begun, and has to hear of its end.
TEST(BulletFewVerdicts, PairsThatAGhostToldTheWorldOfEnd) {
  GhostRig rig;
  btBroadphaseProxy* const at_ghost = rig.create_for(&rig.ghost, cube(50, 0, 0));
  btBroadphaseProxy* const a = rig.create(cube(0, 0, 0));
  btBroadphaseProxy* b = rig.create(cube(btScalar(0.5), 0, 0));
  for (int frame = 0; frame < 8; ++frame) {
    rig.calculate();
    EXPECT_TRUE(rig.holds(a, b)) << frame;
    rig.move(at_ghost, cube(60, 0, btScalar(frame)));
    ASSERT_NO_THROW(dynamic_cast<bullet::Broadphase&>(*rig.broadphase).validate()) << frame;
    rig.destroy(b);
    EXPECT_EQ(rig.pair_count(), 0) << frame;
    b = rig.create(cube(btScalar(0.5), 0, 0));
    ASSERT_NO_THROW(dynamic_cast<bullet::Broadphase&>(*rig.broadphase).validate()) << frame;
  }
}

/// Users remove and add pairs, and a ghost that moves asks for its own before the next batch decides about those.
TEST(BulletFewVerdicts, GhostsDoNotMakeUsersChangesLast) {
  GhostRig rig;
  btBroadphaseProxy* const at_ghost = rig.create_for(&rig.ghost, cube(50, 0, 0));
  btBroadphaseProxy* const a = rig.create(cube(0, 0, 0));
  btBroadphaseProxy* const b = rig.create(cube(btScalar(0.5), 0, 0));
  btBroadphaseProxy* const far = rig.create(cube(20, 0, 0));
  rig.calculate();
  rig.cache().removeOverlappingPair(a, b, nullptr);
  rig.cache().addOverlappingPair(a, far);
  rig.move(at_ghost, cube(60, 0, 0));
  rig.calculate();
  EXPECT_TRUE(rig.holds(a, b));
  EXPECT_FALSE(rig.holds(a, far));
  rig.move(far, cube(0, btScalar(0.5), 0));
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 3);
}

TEST(BulletFewVerdicts, TheOnlyPairIsRemovedByItsUser) {
  Pile pile({}, 1);
  pile.add(pile.places[0]);
  pile.calculate();
  pile.broadphase.getOverlappingPairCache()->removeOverlappingPair(pile.proxies[0], pile.proxies[1], nullptr);
  pile.calculate();
  pile.check("removed", 0);
  pile.remove(0);
  pile.calculate();
  EXPECT_EQ(pile.broadphase.stats().pairs, 0u);
}

/// While a proxy is destroyed, a callback for one of its pairs throws, moves a ghost onto it, or has pairs found.
TEST(BulletFewVerdicts, CallbacksOfADestroyedProxysPairs) {
  for (const int what : {0, 1, 2})
    for (const bool lags : {false, true}) {
      GhostRig rig;
      btBroadphaseProxy* const at_ghost = rig.create_for(&rig.ghost, cube(50, 0, 0));
      btBroadphaseProxy* const middle = rig.create(cube(0, 0, 0));
      btBroadphaseProxy* const one = rig.create(cube(btScalar(0.5), 0, 0));
      btBroadphaseProxy* const other = rig.create(cube(0, btScalar(0.5), 0));
      for (int batch = 0; batch < (lags ? 1 : 60); ++batch) {
        if (!lags) rig.move(at_ghost, cube(50, 0, btScalar(0.001) * btScalar(batch % 2)));
        rig.calculate();
      }
      bool is_first = true;
      rig.log.on_event = [&](const GhostLog::Event&) {
        if (!std::exchange(is_first, false)) return;
        if (what == 0) throw std::runtime_error("of a callback");
        if (what == 1) rig.move(at_ghost, cube(0, 0, btScalar(0.5)));
        if (what == 2) rig.calculate();
      };
      if (what == 0) {
        EXPECT_THROW(rig.destroy(middle), std::runtime_error);
        rig.calculate();
        EXPECT_EQ(rig.pair_count(), 3) << "it has not gone, and its pairs are back";
      }
      rig.destroy(middle);
      rig.calculate();
      EXPECT_TRUE(rig.holds(one, other));
      EXPECT_EQ(rig.pair_count(), what == 1 ? 3 : 1);
      rig.log.on_event = nullptr;
      rig.destroy(one);
      for (int batch = 0; batch < 3; ++batch) rig.calculate();
      EXPECT_EQ(rig.pair_count(), what == 1 ? 1 : 0);
      EXPECT_EQ(rig.log.standing().size(), what == 1 ? 1u : 0u);
    }
}

/// A callback throws as a proxy is destroyed where nothing has moved for long, so that it lives on and is not looked
/// at.
TEST(BulletFewVerdicts, PairsOfAProxyThatLivesOnAreBack) {
  bullet::Options options;
  options.method = Method::hybrid;
  Pile pile(options, 2);
  pile.add(pile.places[0]);
  GhostLog log;
  pile.broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&log);
  for (int batch = 0; batch < 15; ++batch) pile.calculate();
  log.on_event = [](const GhostLog::Event&) { throw std::runtime_error("of a callback"); };
  EXPECT_THROW(pile.broadphase.destroyProxy(pile.proxies[8], nullptr), std::runtime_error);
  log.on_event = nullptr;
  pile.calculate();
  pile.check("it lives on", 0);
  pile.broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(nullptr);
}

/// A callback has pairs found whenever one ends, also among many.
TEST(BulletFewVerdicts, DestroyingEndsThoughCallbacksHavePairsFound) {
  for (const int more : {0, 100}) {
    GhostRig rig;
    btBroadphaseProxy* const a = rig.create(cube(0, 0, 0));
    for (int i = 0; i < 3; ++i) rig.create(cube(btScalar(0.5), btScalar(0.1) * btScalar(i), 0));
    for (int i = 0; i < more; ++i) rig.create(cube(btScalar(10 + 3 * i), 0, 0));
    rig.calculate();
    EXPECT_EQ(rig.pair_count(), 6);
    rig.log.on_event = [&](const GhostLog::Event&) { rig.calculate(); };
    rig.destroy(a);
    rig.log.on_event = nullptr;
    rig.calculate();
    EXPECT_EQ(rig.pair_count(), 3);
    EXPECT_EQ(rig.log.standing().size(), 3u);
  }
}

/// The World has a pair that has ended since, and verdicts are forgotten at some time before the proxy goes.
TEST(BulletFewVerdicts, PairsOfTheWorldEndWithTheirProxy) {
  for (int still = 0; still < 60; ++still) {
    Pile pile({}, 2);
    for (int frame = 0; frame < 40; ++frame) {
      pile.tremble();
      pile.calculate();
    }
    pile.set(0, btVector3(50, 0, 0));
    pile.calculate();
    for (int frame = 0; frame < still; ++frame) {
      pile.set(0, btVector3(50, 0, btScalar(frame % 2)));
      pile.calculate();
    }
    pile.remove(0);
    for (int frame = 0; frame < 40; ++frame) {
      pile.tremble();
      pile.calculate();
      pile.check("after it has gone", still);
    }
  }
}

TEST(BulletFewVerdicts, FiltersThatUsersWriteAreSeen) {
  Pile pile({}, 2);
  for (int frame = 0; frame < 200; ++frame) {
    pile.set(0, pile.places[0] + btVector3(0, 0, btScalar(0.001) * btScalar(frame % 3)));
    pile.calculate();
  }
  const auto wanted = pile.expected();
  ASSERT_FALSE(wanted.empty());
  // What was refused when it would have begun is asked about again once the mask has changed.
  for (btBroadphaseProxy* proxy : pile.proxies) proxy->m_collisionFilterMask = 0;
  pile.set(0, btVector3(9, 9, 9));
  pile.calculate();
  pile.set(0, pile.places[0]);
  pile.calculate();
  EXPECT_LT(pairs_of(pile.broadphase).size(), wanted.size());
  for (btBroadphaseProxy* proxy : pile.proxies) proxy->m_collisionFilterMask = -1;
  for (int batch = 0; batch < 3; ++batch) pile.calculate();
  pile.check("accepted again", 0);
}

/// Before the World has heard of the proxies.
TEST(BulletFewVerdicts, MasksOfNewProxiesMayBeWritten) {
  Pile pile({}, 1);
  pile.add(pile.places[0], 1, 0);
  for (int batch = 0; batch < 3; ++batch) pile.calculate();
  pile.check("refused", 0);
  EXPECT_TRUE(pairs_of(pile.broadphase).empty());
  pile.proxies[1]->m_collisionFilterMask = -1;
  pile.calculate();
  pile.check("accepted", 0);
  EXPECT_EQ(pairs_of(pile.broadphase).size(), 1u);
}

TEST(BulletFewVerdicts, CallbacksAreAskedAboutRefusedPairsInEachMove) {
  Pile pile({}, 2);
  FunctionFilter filter([](btBroadphaseProxy*, btBroadphaseProxy*) { return false; });
  for (int frame = 0; frame < 20; ++frame) pile.calculate();
  pile.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
  pile.add(pile.places[0]);
  for (int frame = 0; frame < 20; ++frame) {
    const long calls = filter.calls;
    pile.set(8, pile.places[8] + btVector3(0, 0, btScalar(0.001) * btScalar(frame % 2 + 1)));
    pile.calculate();
    EXPECT_GT(filter.calls, calls) << frame;
  }
}

/// Although the World has not heard that it was away.
TEST(BulletFewVerdicts, CallbacksAreAskedAboutABoxThatComesBack) {
  bool accepts = false;
  FunctionFilter filter([&](btBroadphaseProxy*, btBroadphaseProxy*) { return accepts; });
  Pile pile({}, 1);
  pile.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
  pile.add(pile.places[0]);
  for (int batch = 0; batch < 3; ++batch) pile.calculate();
  EXPECT_TRUE(pairs_of(pile.broadphase).empty());
  pile.set(1, btVector3(9, 9, 9));
  pile.calculate();
  accepts = true;
  pile.set(1, pile.places[1]);
  pile.calculate();
  EXPECT_EQ(pairs_of(pile.broadphase).size(), 1u);
}

/// As among more of them.
TEST(BulletFewVerdicts, RaysMeetBoxesWithTheirMargin) {
  bullet::Options options;
  options.margin = btScalar(0.125);
  for (const int count : {1, 4, 5, 40}) {
    bullet::Broadphase broadphase(options);
    std::vector<btBroadphaseProxy*> proxies;
    for (int i = 0; i < count; ++i) {
      const Box box = cube(btScalar(3 * i), 0, 0);
      proxies.push_back(broadphase.createProxy(box.lo, box.hi, BOX_SHAPE_PROXYTYPE, nullptr, 1, -1, nullptr));
    }
    for (const btScalar height : {btScalar(0.5), btScalar(0.6), btScalar(0.65)}) {
      const btVector3 from(-2, height, 0), to(2, height, 0);
      FoundOnRay found(from, to);
      broadphase.rayTest(from, to, found);
      EXPECT_EQ(found.proxies.size(), height < btScalar(0.625) ? 1u : 0u) << count << ", at " << height;
    }
    for (btBroadphaseProxy* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
  }
}

/// Found by a look at each.
TEST(BulletFewVerdicts, QueriesMayCreateAndDestroyProxies) {
  struct Replace final : btBroadphaseAabbCallback {
    explicit Replace(Pile& of) : pile(of) {}
    bool process(const btBroadphaseProxy* proxy) override {
      EXPECT_NE(std::find(pile.proxies.begin(), pile.proxies.end(), proxy), pile.proxies.end());
      ++found;
      // All go, and as many that come get their memory.
      const std::size_t count = pile.proxies.size();
      while (!pile.proxies.empty()) pile.remove(0);
      if (resets) pile.broadphase.resetPool(nullptr);
      while (pile.proxies.size() < count) pile.add(btVector3(0, 0, 0));
      return true;
    }
    Pile& pile;
    bool resets = false;
    int found = 0;
  };
  for (const bool resets : {false, true}) {
    Pile pile({}, 2);
    pile.calculate();
    Replace replace(pile);
    replace.resets = resets;
    pile.broadphase.aabbTest(btVector3(-9, -9, -9), btVector3(9, 9, 9), replace);
    EXPECT_EQ(replace.found, 1);
    ASSERT_NO_THROW(pile.broadphase.validate());
  }
}

}  // namespace
}  // namespace boxstream::bullet_test
