// SPDX-License-Identifier: MIT
// Boxes and calls that are known to be hard for a broad-phase, with the oracle beside it.
#include <gtest/gtest.h>
#include <boxstream/bullet.hpp>
#include <boxstream/detector.hpp>

#include <algorithm>
#include <limits>
#include <string>

#include "core/box_sets.hpp"
#include "core/same_pairs.hpp"
#include "oracle.hpp"
#include "small_stack.hpp"
#include "support.hpp"
#include "watched.hpp"

namespace boxstream::bullet_test {
namespace {

using boxstream::tests::box_set;
using boxstream::tests::box_sets;
using boxstream::tests::Boxes;
using boxstream::tests::on_small_stack;

/// Each family of box sets: all new, all moved to another set of the family, a few moved back.
void run_every_box_set(bool borrowed) {
  for (const auto& set : box_sets<btScalar>()) {
    SCOPED_TRACE(set.name);
    btHashedOverlappingPairCache cache;
    Watched watched(borrowed ? &cache : nullptr);
    const auto first = set.make(200, 1), second = set.make(200, 2);
    const auto proxies = watched.create(first);
    ASSERT_TRUE(watched.calculate());
    for (std::size_t i = 0; i < proxies.size(); ++i) watched.rig.move(proxies[i], to_box(second[i]));
    ASSERT_TRUE(watched.calculate());
    for (std::size_t i = 0; i < proxies.size(); i += 19) watched.rig.move(proxies[i], to_box(first[i]));
    ASSERT_TRUE(watched.calculate());
    for (std::size_t i = 0; i < proxies.size(); i += 2) watched.rig.destroy(proxies[i]);
    ASSERT_TRUE(watched.oracle->check(Rule::exact)) << "after half were destroyed";
  }
}

TEST(BulletHardBoxes, EveryBoxSet) {
  run_every_box_set(false);
}

TEST(BulletHardBoxes, EveryBoxSetWithABorrowedCache) {
  run_every_box_set(true);
}

/// A box becomes bad and good again: the pairs of all others are the same before, meanwhile and after.
void bad_box_disturbs_no_other_pair(btOverlappingPairCache* cache) {
  using Limits = std::numeric_limits<btScalar>;
  Watched watched(cache);
  const auto boxes = box_set<btScalar>("dense").make(150, 3);
  const auto proxies = watched.create(boxes);
  ASSERT_TRUE(watched.calculate());
  btBroadphaseProxy* const victim = proxies[70];
  const auto before = sorted(watched.rig.pairs());
  auto of_others = before;
  std::erase_if(of_others, [&](UidPair p) { return p.first == victim->m_uniqueId || p.second == victim->m_uniqueId; });
  ASSERT_LT(of_others.size(), before.size());
  std::vector<Box> bad = {{btVector3(9, 9, 9), btVector3(1, 1, 1)}};
  for (int side = 0; side < 6; ++side)
    for (const btScalar value : {Limits::quiet_NaN(), -Limits::quiet_NaN(), Limits::signaling_NaN()}) {
      bad.push_back({btVector3(1, 1, 1), btVector3(9, 9, 9)});
      (side < 3 ? bad.back().lo : bad.back().hi)[side % 3] = value;
    }
  for (int axis = 0; axis < 3; ++axis) {
    bad.push_back({btVector3(-9, -9, -9), btVector3(99, 99, 99)});
    bad.back().lo[axis] = Limits::infinity();
    bad.back().hi[axis] = -Limits::infinity();
  }
  for (std::size_t i = 0; i < bad.size(); ++i) {
    SCOPED_TRACE(i);
    watched.rig.move(victim, bad[i]);
    ASSERT_TRUE(watched.calculate());
    ASSERT_EQ(sorted(watched.rig.pairs()), of_others);
    watched.rig.move(victim, to_box(boxes[70]));
    ASSERT_TRUE(watched.calculate());
    ASSERT_EQ(sorted(watched.rig.pairs()), before);
  }
}

TEST(BulletHardBoxes, NanOrInvertedDisturbsNoOtherPair) {
  bad_box_disturbs_no_other_pair(nullptr);
  btHashedOverlappingPairCache cache;
  bad_box_disturbs_no_other_pair(&cache);
}

TEST(BulletHardBoxes, SizesUpTo130) {
  for (const char* name : {"dense", "ties", "identical"}) {
    SCOPED_TRACE(name);
    Watched watched;
    ASSERT_TRUE(watched.calculate());
    std::vector<btBroadphaseProxy*> proxies;
    for (const auto& box : box_set<btScalar>(name).make(130, 1)) {  // and each size on the way
      proxies.push_back(watched.rig.create(to_box(box)));
      ASSERT_TRUE(watched.calculate());
    }
    for (std::size_t i = 0; i < 130; ++i) {
      watched.rig.destroy(proxies[i * 37 % 130]);
      ASSERT_TRUE(watched.calculate());
    }
    EXPECT_EQ(watched.rig.pair_count(), 0);
  }
}

/// Far beyond what the pair array holds at first: it grows, and loses nothing.
TEST(BulletHardBoxes, AMillionPairsAtOnce) {
  Rig rig;
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 1500; ++i) proxies.push_back(rig.create(cube(0, 0, 0)));
  rig.calculate();
  ASSERT_EQ(rig.pair_count(), 1500 * 1499 / 2);
  const auto pairs = rig.pairs();
  std::size_t next = 0;
  for (int a = 1; a <= 1500; ++a)
    for (int b = a + 1; b <= 1500; ++b) ASSERT_EQ(pairs[next++], UidPair(a, b));
  for (int i = 0; i < 1500; ++i) rig.move(proxies[static_cast<std::size_t>(i)], cube(btScalar(2 * i), 0, 0));
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 0);
}

/// Of boxes that no axis parts well, or few large among very many small ones, a batch compares no more than a
/// Detector does, whose work the tests of the core bound.
TEST(BulletHardBoxes, BatchesCompareNoMoreThanADetector) {
  for (const char* name : {"comb_and_plates_x", "comb_and_plates_y", "comb_and_plates_z", "spanning_the_median",
                           "dust_and_planes", "rods_mixed"}) {
    SCOPED_TRACE(name);
    const auto boxes = box_set<btScalar>(name).make(6000, 1);
    std::vector<boxstream::Pair> found;
    const boxstream::Stats alone = boxstream::Detector().find_pairs(boxes, found);
    Rig rig;
    auto* broadphase = new boxstream::bullet::Broadphase;
    rig.broadphase.reset(broadphase);
    for (const auto& box : boxes) rig.create(to_box(box));
    rig.calculate();
    EXPECT_EQ(static_cast<std::size_t>(rig.pair_count()), found.size());
    EXPECT_LE(broadphase->stats().search.tests, alone.tests);
    EXPECT_GT(broadphase->stats().search.tests, 0u);
  }
}

TEST(BulletHardBoxes, BoxesThatChangePlaces) {
  Watched watched;
  GhostLog ghost;
  watched.rig.cache().setInternalGhostPairCallback(&ghost);
  auto boxes = box_set<btScalar>("dense").make(150, 4);
  const auto proxies = watched.create(boxes);
  ASSERT_TRUE(watched.calculate());
  Random random(5);
  for (int frame = 0; frame < 15; ++frame) {
    for (int swap = 0; swap < 1 + 3 * frame; ++swap) {
      const auto i = static_cast<std::size_t>(random.below(150)), j = static_cast<std::size_t>(random.below(150));
      std::swap(boxes[i], boxes[j]);
      watched.rig.move(proxies[i], to_box(boxes[i]));
      watched.rig.move(proxies[j], to_box(boxes[j]));
    }
    ASSERT_TRUE(watched.calculate()) << "frame " << frame;
    ASSERT_EQ(ghost.standing(), sorted(watched.rig.pairs())) << "frame " << frame;
  }
  watched.rig.cache().setInternalGhostPairCallback(nullptr);
}

TEST(BulletHardBoxes, ManyAtRestAndFewThatMove) {
  Watched watched;
  const auto boxes = box_set<btScalar>("touching_lattice").make(1000, 1);
  const auto proxies = watched.create(boxes);
  ASSERT_TRUE(watched.calculate());
  Random random(5);
  for (int frame = 0; frame < 12; ++frame) {
    for (int i = 0; i < 5; ++i)  // others each four frames
      watched.rig.move(proxies[static_cast<std::size_t>(frame / 4 * 300 + 7 * i)],
                       to_box(boxes[static_cast<std::size_t>(random.below(1000))]));
    ASSERT_TRUE(watched.calculate()) << "frame " << frame;
  }
  for (btBroadphaseProxy* proxy : proxies) watched.rig.destroy(proxy);
  EXPECT_EQ(watched.rig.pair_count(), 0);
  ASSERT_TRUE(watched.calculate());
}

/// The order of creation decides the order of pairs, never which they are.
TEST(BulletHardBoxes, ShuffledCreationGivesTheSamePairs) {
  Random random(6);
  for (const char* name : {"dense", "ties", "rods_mixed"}) {
    const auto boxes = box_set<btScalar>(name).make(400, 1);
    const auto truth = boxstream::tests::brute_force(boxes);
    std::vector<std::uint32_t> order(boxes.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    for (int round = 0; round < 5; ++round) {
      for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
      Rig rig;
      for (const std::uint32_t i : order) rig.create(to_box(boxes[i]));
      rig.calculate();
      boxstream::tests::Pairs found;
      for (const auto& [a, b] : rig.pairs()) {
        const auto [low, high] =
            std::minmax(order[static_cast<std::size_t>(a - 1)], order[static_cast<std::size_t>(b - 1)]);
        found.push_back({low, high});
      }
      ASSERT_TRUE(boxstream::tests::expect_same_pairs(found, truth, boxes, name, 1));
    }
  }
}

TEST(BulletHardBoxes, BatchesAndQueriesFitOnASmallStack) {
  for (const char* name : {"dense", "comb_and_plates_z", "nested", "rods_mixed"}) {
    SCOPED_TRACE(name);
    const auto& set = box_set<btScalar>(name);
    const auto boxes = set.make(std::min<std::size_t>(17000, set.largest), 1);
    std::vector<boxstream::Pair> found;
    boxstream::Detector().find_pairs(boxes, found);
    Rig rig;
    std::vector<btBroadphaseProxy*> proxies;
    int pairs = 0;
    std::size_t in_box = 0, on_ray = 0;
    on_small_stack([&] {
      for (const auto& box : boxes) proxies.push_back(rig.create(to_box(box)));
      rig.calculate();
      pairs = rig.pair_count();
      in_box = rig.in_box({btVector3(-1e6, -1e6, -1e6), btVector3(1e6, 1e6, 1e6)}).size();
      on_ray = rig.on_ray(proxies[0]->m_aabbMin, proxies[0]->m_aabbMax).size();
      for (std::size_t i = 0; i < proxies.size(); i += 2) rig.destroy(proxies[i]);
      rig.calculate();
    });
    EXPECT_EQ(static_cast<std::size_t>(pairs), found.size());
    EXPECT_EQ(in_box, boxes.size());
    EXPECT_GE(on_ray, 1u);
    EXPECT_LT(rig.pair_count(), pairs);
  }
}

}  // namespace
}  // namespace boxstream::bullet_test
