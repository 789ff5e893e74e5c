// SPDX-License-Identifier: MIT
// Clauses P1 and P2 where there are so few proxies that verdicts about them are kept as bits.
#include <boxstream/bullet.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "oracle.hpp"
#include "pile.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

/// A few change in each frame: they tremble, go far, come, go, become invalid, or a user removes a pair.
void live_on(Pile& pile, Random& random, int frame) {
  for (int times = random.below(4); times > 0 && !pile.proxies.empty(); --times) {
    const auto one = std::size_t(random.below(int(pile.proxies.size())));
    pile.set(one, pile.places[one] += random.vector(btScalar(-0.02), btScalar(0.02)));
  }
  if (frame % 7 != 3 || pile.proxies.empty()) return;
  const auto one = std::size_t(random.below(int(pile.proxies.size())));
  switch (random.below(6)) {
    case 0:
      return pile.add(random.vector(-2, 2));
    case 1:
      return pile.remove(one);
    case 2:
      return pile.set(one, pile.places[one] = random.vector(-2, 2));
    case 3:
      return pile.broadphase.setAabb(pile.proxies[one], btVector3(1, 1, 1), btVector3(-1, 1, 1), nullptr);
    case 4:
      pile.remove(one);
      return pile.add(random.vector(-2, 2));
    default: {
      btOverlappingPairCache& cache = *pile.broadphase.getOverlappingPairCache();
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
    for (const int more : {-7, -4, 0, 3, 5}) {
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
