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

TEST(BulletFewVerdicts, PairsAreThoseThatTouch) {
  for (const btScalar margin : {btScalar(0), btScalar(0.01)})
    for (const int side : {1, 2, 3, 4}) {
      bullet::Options options;
      options.margin = margin;
      Pile pile(options, side, std::uint64_t(side));
      Random random(17);
      for (int frame = 0; frame < 1500; ++frame) {
        live_on(pile, random, frame);
        if (random.below(5) == 0) continue;  // several changes before a batch
        pile.calculate();
        if (margin == 0) pile.check("a few", frame);
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

TEST(BulletFewVerdicts, ComingAndGoingWithoutEndKeepsNoMemory) {
  Pile pile({}, 1);
  pile.calculate();
  for (int turn = 0; turn < 10000; ++turn) {
    pile.add(btVector3(btScalar(5 + turn % 7), 0, 0));
    pile.calculate();
    pile.remove(turn % 2 == 0 ? 1 : 0);
    pile.calculate();
  }
  EXPECT_LT(pile.broadphase.stats().proxies, 3u);
  ASSERT_NO_THROW(pile.broadphase.validate());
}

/// Found by a look at each.
TEST(BulletFewVerdicts, QueriesMayCreateAndDestroyProxies) {
  struct Replace final : btBroadphaseAabbCallback {
    explicit Replace(Pile& of) : pile(of) {}
    bool process(const btBroadphaseProxy* proxy) override {
      EXPECT_NE(std::find(pile.proxies.begin(), pile.proxies.end(), proxy), pile.proxies.end());
      ++found;
      // All others go, and one of those that come gets the memory of one that was found.
      while (pile.proxies.size() > 1) pile.remove(pile.proxies[0] == proxy ? 1 : 0);
      pile.add(btVector3(0, 0, 0));
      return true;
    }
    Pile& pile;
    int found = 0;
  };
  Pile pile({}, 2);
  pile.calculate();
  Replace replace(pile);
  pile.broadphase.aabbTest(btVector3(-9, -9, -9), btVector3(9, 9, 9), replace);
  EXPECT_EQ(replace.found, 1);
  ASSERT_NO_THROW(pile.broadphase.validate());
}

}  // namespace
}  // namespace boxstream::bullet_test
