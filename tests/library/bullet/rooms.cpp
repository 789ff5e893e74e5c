// SPDX-License-Identifier: MIT
// Clauses P1 and P2 where boxes tremble: what is not looked at again changes no pair.
#include <boxstream/bullet.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "oracle.hpp"
#include "pile.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

TEST(BulletRooms, PairsAreThoseThatTouch) {
  for (const btScalar margin : {btScalar(0), btScalar(0.01)}) {
    bullet::Options options;
    options.margin = margin;
    Pile pile(options);
    Random random(7);
    std::size_t begun = 0;
    for (int frame = 0; frame < 400; ++frame) {
      for (btVector3& place : pile.places) place += random.vector(btScalar(-0.001), btScalar(0.001));
      pile.tremble();
      pile.calculate();
      begun += frame > 50 ? pile.broadphase.stats().begun : 0;
      if (margin == 0) pile.check("trembling", frame);
      ASSERT_NO_THROW(pile.broadphase.validate()) << frame;
    }
    EXPECT_EQ(pile.broadphase.stats().moved, 0u);
    EXPECT_GT(begun, 20u);
  }
}

TEST(BulletRooms, OneThatGoesFarIsFollowed) {
  Pile pile;
  pile.settle();
  for (int frame = 0; frame < 120; ++frame) {
    pile.places[0] += btVector3(btScalar(0.06), btScalar(0.05), btScalar(0.04));
    pile.tremble();
    pile.calculate();
    pile.check("one goes", frame);
    EXPECT_EQ(pile.broadphase.stats().moved, 0u) << frame;
  }
}

TEST(BulletRooms, EverythingElseEndsThem) {
  Pile pile;
  Random random(11);
  for (int frame = 0; frame < 900; ++frame) {
    pile.tremble();
    const auto one = std::size_t(random.below(int(pile.proxies.size())));
    if (frame % 45 == 44) switch (random.below(8)) {
        case 0:
          pile.add(random.vector(-2, 2));
          break;
        case 1:
          pile.remove(one);
          break;
        case 2:
          pile.set(one, pile.places[one] = random.vector(-2, 2));
          break;
        case 3:
          pile.proxies[one]->m_collisionFilterMask = random.below(2) == 0 ? 0 : -1;
          break;
        case 4:
          pile.broadphase.refilter();
          break;
        case 5:
          pile.broadphase.shrink_to_fit();
          break;
        case 6:
          pile.broadphase.setAabb(pile.proxies[one], btVector3(1, 1, 1), btVector3(-1, 1, 1), nullptr);
          break;
        default: {
          btOverlappingPairCache& cache = *pile.broadphase.getOverlappingPairCache();
          if (cache.getNumOverlappingPairs() == 0) break;
          const btBroadphasePair pair = cache.getOverlappingPairArrayPtr()[cache.getNumOverlappingPairs() / 2];
          cache.removeOverlappingPair(pair.m_pProxy0, pair.m_pProxy1, nullptr);
        }
      }
    pile.calculate();
    // Pairs that are held stay when masks change.
    if (std::all_of(pile.proxies.begin(), pile.proxies.end(),
                    [](const btBroadphaseProxy* proxy) { return proxy->m_collisionFilterMask == -1; }))
      pile.check("and so on", frame);
    else if (frame % 45 == 43)
      for (btBroadphaseProxy* proxy : pile.proxies) proxy->m_collisionFilterMask = -1;
    ASSERT_NO_THROW(pile.broadphase.validate()) << frame;
  }
}

TEST(BulletRooms, QueriesSeeThePresentBoxes) {
  Pile pile;
  pile.settle();
  for (int frame = 0; frame < 40; ++frame) {
    pile.tremble();
    if (frame % 3 != 0) pile.calculate();
    for (const btBroadphaseProxy* proxy : pile.proxies) {
      // A sheet at the upper face, and one just above it.
      const btVector3 hi = proxy->m_aabbMax, above(hi.x(), hi.y(), std::nextafter(hi.z(), btScalar(100)));
      for (const bool touches : {true, false}) {
        Found found;
        const btVector3& at = touches ? hi : above;
        pile.broadphase.aabbTest(at, at, found);
        const auto place = std::find(found.proxies.begin(), found.proxies.end(), proxy);
        ASSERT_EQ(place != found.proxies.end(), touches) << frame;
      }
      if (frame % 8 != 0) break;
    }
  }
}

TEST(BulletRooms, EagerPairsAreThereAtOnce) {
  bullet::Options options;
  options.eager = bullet::Eager::all;
  Pile pile(options);
  Random random(5);
  for (int frame = 0; frame < 80; ++frame) {
    for (std::size_t i = 0; i < pile.proxies.size(); ++i) {
      pile.places[i] += random.vector(btScalar(-0.002), btScalar(0.002));
      if (frame > 60 && i % 40 == 0) pile.places[i] += btVector3(0, btScalar(0.2), 0);
      pile.set(i, pile.places[i]);
      if (frame < 20) continue;
      const btBroadphaseProxy* const moved = pile.proxies[i];
      for (btBroadphaseProxy* other : pile.proxies)
        if (other != moved && boxes_overlap(moved->m_aabbMin, moved->m_aabbMax, other->m_aabbMin, other->m_aabbMax)) {
          ASSERT_NE(find_in_array(pile.broadphase, moved, other), nullptr) << frame;
        }
    }
    pile.calculate();
    pile.check("eager", frame);
  }
}

TEST(BulletRooms, RefusedPairsAreAskedAboutInEachMove) {
  Pile pile;
  pile.settle();
  bool refuses = true;
  const btBroadphaseProxy *one = pile.proxies[0], *other = pile.proxies.back();
  FunctionFilter filter([&](btBroadphaseProxy* a, btBroadphaseProxy* b) { return !refuses || a != one || b != other; });
  pile.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
  pile.places[0] = pile.places.back();
  for (int frame = 0; frame < 60; ++frame) {
    pile.tremble();
    pile.calculate();
    EXPECT_EQ(find_in_array(pile.broadphase, one, other), nullptr) << frame;
  }
  refuses = false;
  pile.tremble();
  pile.calculate();
  EXPECT_NE(find_in_array(pile.broadphase, one, other), nullptr);
  pile.check("accepted", 0);
  pile.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(nullptr);
}

TEST(BulletRooms, AFilterThatThrowsLosesNothing) {
  Pile pile;
  bool throws = false;
  FunctionFilter filter([&](btBroadphaseProxy*, btBroadphaseProxy*) {
    if (throws) throw std::runtime_error("no");
    return true;
  });
  pile.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
  pile.settle();
  pile.places[0] = pile.places.back() + btVector3(btScalar(0.1), 0, 0);
  pile.tremble();
  throws = true;
  EXPECT_THROW(pile.calculate(), std::runtime_error);
  throws = false;
  pile.calculate();
  pile.check("after it", 0);
  pile.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(nullptr);
}

/// Looks at the pairs in one of several ways; some do so while another one is under way.
struct Reader final : btOverlapCallback {
  Reader(btOverlappingPairCache& read, Random& numbers) : cache(read), random(numbers) {}

  bool processOverlap(btBroadphasePair& pair) override {
    visited.emplace_back(pair.m_pProxy0->m_uniqueId, pair.m_pProxy1->m_uniqueId);
    if (random.below(100) == 0) {
      EXPECT_EQ(cache.findPair(pair.m_pProxy0, pair.m_pProxy1), &pair);
      const auto place = std::ptrdiff_t(visited.size()) - 1;
      EXPECT_EQ(cache.getOverlappingPairArrayPtr() + place, &pair);
    }
    return false;
  }

  btOverlappingPairCache& cache;
  Random& random;
  std::vector<UidPair> visited;
};

TEST(BulletRooms, PairsAreInOrderWhoeverReadsThem) {
  Random random(17);
  for (const bool is_lent : {false, true}) {
    Pile pile({}, 7, 3 + is_lent);
    btOverlappingPairCache& cache = *pile.broadphase.getOverlappingPairCache();
    const btBroadphasePairArray* const array = is_lent ? &cache.getOverlappingPairArray() : nullptr;
    for (int frame = 0; frame < 300; ++frame) {
      for (btVector3& place : pile.places) place += random.vector(btScalar(-0.001), btScalar(0.001));
      if (random.below(8) == 0) pile.places[std::size_t(random.below(343))] = random.vector(-2, 5);
      pile.tremble();
      pile.calculate();
      const std::vector<UidPair> expected = pile.expected();
      ASSERT_EQ(std::size_t(cache.getNumOverlappingPairs()), expected.size()) << frame;
      if (array != nullptr) {
        ASSERT_EQ(std::size_t(array->size()), expected.size()) << frame;
        for (int i = 0; i < array->size(); ++i) {
          ASSERT_EQ((*array)[i].m_pProxy0->m_uniqueId, expected[std::size_t(i)].first) << frame;
          ASSERT_EQ((*array)[i].m_pProxy1->m_uniqueId, expected[std::size_t(i)].second) << frame;
        }
      }
      switch (random.below(5)) {
        case 0:
          break;
        case 1:
          pile.check("by its pointer", frame);
          break;
        case 2:
          for (const btBroadphaseProxy* const proxy : {pile.proxies[3], pile.proxies.back()})
            for (btBroadphaseProxy* other : pile.proxies) {
              const UidPair pair = std::minmax(proxy->m_uniqueId, other->m_uniqueId);
              ASSERT_EQ(cache.findPair(const_cast<btBroadphaseProxy*>(proxy), other) != nullptr,
                        std::binary_search(expected.begin(), expected.end(), pair))
                  << frame;
            }
          break;
        default: {
          Reader reader(cache, random);
          cache.processAllOverlappingPairs(&reader, nullptr);
          ASSERT_EQ(reader.visited, expected) << frame;
        }
      }
    }
  }
}

TEST(BulletRooms, BoxesAtZeroAndFarOut) {
  Pile pile;
  const auto box = [&](const btVector3& lo, const btVector3& hi) {
    pile.places.push_back(btVector3(0, 0, 0));
    pile.proxies.push_back(pile.broadphase.createProxy(lo, hi, BOX_SHAPE_PROXYTYPE, nullptr, 1, -1, nullptr));
    return pile.proxies.back();
  };
  const btScalar inf = std::numeric_limits<btScalar>::infinity();
  btBroadphaseProxy* const half_space = box(btVector3(-inf, -inf, -inf), btVector3(inf, inf, 0));
  btBroadphaseProxy* const sheet = box(btVector3(-1, -1, 0), btVector3(1, 1, 0));
  btBroadphaseProxy* const none = box(btVector3(1, 1, 1), btVector3(-1, 1, 1));
  Random random(9);
  for (int frame = 0; frame < 120; ++frame) {
    for (std::size_t i = 0; i + 3 < pile.proxies.size(); ++i)
      pile.set(i, pile.places[i] + random.vector(btScalar(-0.002), btScalar(0.002)));
    const btScalar top = random.below(2) == 0 ? btScalar(0) : -btScalar(0);
    pile.broadphase.setAabb(sheet, btVector3(-1, -1, random.real(btScalar(-0.001), 0)), btVector3(1, 1, top), nullptr);
    if (frame > 60)
      pile.broadphase.setAabb(half_space, half_space->m_aabbMin, btVector3(inf, inf, random.real(-1, 1)), nullptr);
    if (frame == 100) pile.broadphase.setAabb(none, btVector3(-1, -1, -1), btVector3(1, 1, 1), nullptr);
    pile.calculate();
    pile.check("extremes", frame);
  }
}

/// Masks that are written while one box trembles.
TEST(BulletRooms, WrittenMasksAreNoticedBesideAMover) {
  Rig rig;
  auto* const broadphase = new bullet::Broadphase;
  rig.broadphase.reset(broadphase);
  std::vector<btBroadphaseProxy*> pairs;
  for (int i = 0; i < 600; ++i) pairs.push_back(rig.create(cube(btScalar(10 * (i / 2)), 0, 0), 1, 2));
  btBroadphaseProxy* const mover = rig.create(cube(0, 50, 0));
  int batches = 0;
  const auto tremble = [&] {
    rig.move(mover, cube(0, btScalar(50) + (++batches % 2 == 0 ? btScalar(0.001) : btScalar(-0.001)), 0));
    rig.calculate();
  };
  for (int batch = 0; batch < 50; ++batch) tremble();
  ASSERT_EQ(broadphase->stats().moved, 0u) << "no rooms";
  for (const std::size_t i : {400u, 401u}) pairs[i]->m_collisionFilterMask = 1;
  for (int batch = 0; batch < 60; ++batch) tremble();
  EXPECT_EQ(rig.pair_count(), 1);
  broadphase->validate();
}

/// After `resetPool` the same calls have the same results, counts of what was looked at included.
TEST(BulletRooms, ResetForgetsWhatWasBefore) {
  bullet::Options options;
  bullet::Broadphase broadphase(options);
  const auto run = [&] {
    std::vector<std::uint64_t> log;
    Random random(5);
    std::vector<btBroadphaseProxy*> proxies;
    std::vector<btVector3> places;
    for (int i = 0; i < 60; ++i) {
      places.push_back(random.vector(-2, 2));
      const Box box = cube(places.back().x(), places.back().y(), places.back().z());
      proxies.push_back(
          broadphase.createProxy(box.lo, box.hi, 0, nullptr, i % 9 == 0 ? 2 : 1, i % 7 == 0 ? 1 : -1, nullptr));
    }
    for (int frame = 0; frame < 150; ++frame) {
      const btScalar by = frame % 50 < 25 ? btScalar(0.001) : btScalar(0.2);
      for (std::size_t i = 0; i < proxies.size(); ++i) {
        const btVector3 at = places[i] + random.vector(-by, by);
        const Box box = cube(at.x(), at.y(), at.z());
        broadphase.setAabb(proxies[i], box.lo, box.hi, nullptr);
      }
      broadphase.calculateOverlappingPairs(nullptr);
      const WorldStats& stats = broadphase.stats();
      log.insert(log.end(), {stats.moved, stats.begun, stats.ended, stats.pairs});
    }
    for (btBroadphaseProxy* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
    broadphase.resetPool(nullptr);
    return log;
  };
  const auto first = run();
  EXPECT_EQ(run(), first);
  EXPECT_EQ(run(), first);
}

}  // namespace
}  // namespace boxstream::bullet_test
