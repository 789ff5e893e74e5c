// SPDX-License-Identifier: MIT
// Boxes that are known to be hard, in every way in which an update can search, against brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/box_sets.hpp"
#include "core/fast_oracle.hpp"
#include "core/random.hpp"
#include "core/same_pairs.hpp"
#include "sanitized.hpp"
#include "small_stack.hpp"
#include "watched_world.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class HardBoxes : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(HardBoxes, Scalars);

/// Each family of box sets: all new, all moved to another set of the family, a few moved back.
TYPED_TEST(HardBoxes, EveryBoxSetInEveryWayOfSearching) {
  for (const auto mode : search_modes)
    for (const auto& set : box_sets_to_repeat<TypeParam>()) {
      SCOPED_TRACE(set.name + ", mode " + std::to_string(int(mode)));
      const auto first = set.make(300, 1), second = set.make(300, 2);
      WatchedWorld<TypeParam> watched(mode);
      watched.create(first);
      watched.update();
      for (std::uint32_t i = 0; i < 300; ++i) watched.move(i, second[i]);
      watched.update();
      for (std::uint32_t i = 0; i < 300; i += 29) watched.move(i, first[i]);
      watched.update();
      watched.update();
      if (this->HasFailure()) return;
    }
}

/// The same by the paper's tree: a batch of all in each update in which anything has changed, and none in others.
TYPED_TEST(HardBoxes, EveryBoxSetByTheHybridMethod) {
  WorldOptions options;
  options.method = Method::hybrid;
  for (const auto& set : box_sets_to_repeat<TypeParam>())
    for (const std::uint32_t cutoff : {0u, 16u}) {
      SCOPED_TRACE(set.name + ", cutoff " + std::to_string(cutoff));
      options.cutoff = cutoff;
      const auto first = set.make(300, 1), second = set.make(300, 2);
      WatchedWorld<TypeParam> watched(detail::SearchMode::cheapest, options);
      watched.create(first);
      EXPECT_EQ(watched.update().search.boxes, 300u);
      for (std::uint32_t i = 0; i < 300; ++i) watched.move(i, second[i]);
      const WorldStats stats = watched.update();
      EXPECT_EQ(stats.search.boxes, stats.moved > 0 ? 300u : 0u);
      watched.move(7, first[7]);
      watched.destroy(9);
      EXPECT_EQ(watched.update().search.boxes, 300u);
      EXPECT_EQ(watched.update().search.boxes, 0u);
      if (this->HasFailure()) return;
    }
}

TYPED_TEST(HardBoxes, SizesUpTo130) {
  for (const auto mode : search_modes)
    for (const char* name : {"dense", "ties", "identical", "rods_mixed"}) {
      SCOPED_TRACE(name);
      const auto boxes = box_set<TypeParam>(name).make(130, 1);
      WatchedWorld<TypeParam> watched(mode);
      watched.update();
      for (const auto& box : boxes) {  // and each size on the way
        watched.create({box});
        watched.update();
      }
      for (std::uint32_t i = 0; i < 130; ++i) {
        watched.destroy(i * 37 % 130);
        if (i % 8 == 0 || i > 120) watched.update();
      }
      EXPECT_EQ(watched.world().size(), 0u);
      if (this->HasFailure()) return;
    }
}

/// A box becomes `bad` and good again: the pairs of all others are the same before, meanwhile and after.
template <class S>
void expect_others_undisturbed(const std::vector<BasicAabb<S>>& bad) {
  const auto boxes = box_set<S>("dense").make(200, 3);
  const std::uint32_t victim = 100;
  const auto of_others = [&](Pairs pairs) {
    std::erase_if(pairs, [&](Pair p) { return p.a == victim || p.b == victim; });
    return pairs;
  };
  for (const auto mode : search_modes) {
    WatchedWorld<S> watched(mode);
    watched.create(boxes);
    watched.update();
    const Pairs before = watched.held();
    ASSERT_LT(of_others(before).size(), before.size());
    for (const auto& box : bad) {
      SCOPED_TRACE(describe(box) + ", mode " + std::to_string(int(mode)));
      watched.move(victim, box);
      EXPECT_EQ(watched.update().invalid, 1u);
      ASSERT_EQ(watched.held(), of_others(before));
      watched.move(victim, boxes[victim]);
      EXPECT_EQ(watched.update().invalid, 0u);
      ASSERT_EQ(watched.held(), before);
    }
  }
}

TYPED_TEST(HardBoxes, NanOnAnySideDisturbsNoOtherPair) {
  using Limits = std::numeric_limits<TypeParam>;
  std::vector<BasicAabb<TypeParam>> bad;
  for (int side = 0; side < 6; ++side)
    for (const TypeParam nan : {Limits::quiet_NaN(), -Limits::quiet_NaN(), Limits::signaling_NaN()}) {
      bad.push_back({{1, 1, 1}, {9, 9, 9}});
      (side < 3 ? bad.back().min : bad.back().max)[side % 3] = nan;
    }
  expect_others_undisturbed(bad);
}

TYPED_TEST(HardBoxes, InvertedOnAnyAxisDisturbsNoOtherPair) {
  constexpr TypeParam inf = std::numeric_limits<TypeParam>::infinity(), most = std::numeric_limits<TypeParam>::max();
  std::vector<BasicAabb<TypeParam>> bad = {{{inf, inf, inf}, {-inf, -inf, -inf}}, {{9, 9, 9}, {1, 1, 1}}};
  for (int axis = 0; axis < 3; ++axis)
    for (const TypeParam end : {TypeParam(5), most, inf}) {
      bad.push_back({{-9, -9, -9}, {99, 99, 99}});
      bad.back().min[axis] = end;
      bad.back().max[axis] = -end;
    }
  expect_others_undisturbed(bad);
}

TYPED_TEST(HardBoxes, PointsAndFlatBoxesTouchAndZeroHasNoSign) {
  using Box = BasicAabb<TypeParam>;
  const TypeParam zero = 0;
  const std::vector<Box> boxes = {{{0, 0, 0}, {1, 1, 1}},
                                  {{-1, -1, -1}, {-zero, -zero, -zero}},  // a corner at the other zero
                                  {{-zero, zero, -zero}, {zero, -zero, zero}},
                                  {{1, 0, 0}, {1, 1, 1}},  // a face
                                  {{1, 1, 0}, {1, 1, 1}},  // an edge
                                  {{1, 1, 1}, {1, 1, 1}}};
  const Pairs expected = {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}, {1, 2}, {3, 4}, {3, 5}, {4, 5}};
  for (const auto mode : search_modes) {
    WatchedWorld<TypeParam> watched(mode);
    watched.create(boxes);
    watched.update();
    EXPECT_EQ(watched.held(), expected);
  }
}

/// Of boxes that no axis parts well, or few large among very many small ones, an update compares no more than a
/// Detector does, whose work is bounded in work_test.cpp.
TYPED_TEST(HardBoxes, UpdatesCompareNoMoreThanADetector) {
  for (const char* name : {"comb_and_plates_x", "comb_and_plates_y", "comb_and_plates_z", "spanning_the_median",
                           "dust_and_planes", "slices_y", "rods_mixed"}) {
    SCOPED_TRACE(name);
    const auto boxes = box_set<TypeParam>(name).make(6000, 1);
    Pairs found;
    const Stats alone = Detector().find_pairs(boxes, found);
    WatchedWorld<TypeParam> watched(detail::SearchMode::all);
    watched.create(boxes);
    const WorldStats stats = watched.update();
    EXPECT_EQ(stats.pairs, found.size());
    EXPECT_LE(stats.search.tests, alone.tests);
    EXPECT_GT(stats.search.tests, 0u);
  }
}

TYPED_TEST(HardBoxes, ManyAtRestAndFewThatMove) {
  for (const auto mode : search_modes) {
    SCOPED_TRACE(int(mode));
    const auto boxes = box_set<TypeParam>("touching_lattice").make(2000, 1);
    WatchedWorld<TypeParam> watched(mode);
    watched.create(boxes);
    watched.update();
    Random random(5);
    for (int frame = 0; frame < (sanitized ? 5 : 15); ++frame) {
      // Others each five frames: what was at rest moves, and what moved comes to rest where it is.
      for (std::uint32_t i = 0; i < 5; ++i) {
        const std::uint32_t mover = static_cast<std::uint32_t>(frame / 5) * 500 + 3 * i;
        watched.move(mover, boxes[random.index(boxes.size())]);
      }
      watched.update();
      ASSERT_FALSE(this->HasFailure());
    }
    for (std::uint32_t i = 0; i < boxes.size(); ++i) watched.destroy(i);
    watched.update();
    EXPECT_EQ(watched.world().pair_count(), 0u);
  }
}

TYPED_TEST(HardBoxes, UpdateFitsOnASmallStack) {
  for (const char* name : {"dense", "comb_and_plates_z", "nested", "rods_mixed", "ties"}) {
    SCOPED_TRACE(name);
    const auto& set = box_set<TypeParam>(name);
    const std::size_t n = std::min<std::size_t>(8000, set.largest);
    const auto first = set.make(n, 1), second = set.make(n, 2);
    const std::size_t first_pairs = sweep(first).size(), second_pairs = sweep(second).size();
    for (const auto mode : search_modes) {
      WorldStats stats[2];
      on_small_stack([&] {
        detail::WorldCore<TypeParam> world({}, mode);
        std::vector<ProxyId> ids(n);
        world.create(first, {}, ids, {});
        stats[0] = world.update();
        world.move(Span<const ProxyId>(ids), Span<const BasicAabb<TypeParam>>(second));
        stats[1] = world.update();
      });
      EXPECT_EQ(stats[0].pairs, first_pairs);
      EXPECT_EQ(stats[1].pairs, second_pairs);
    }
  }
}

/// The order of creation decides the order of pairs, never which they are.
TYPED_TEST(HardBoxes, ShuffledCreationGivesTheSamePairs) {
  Random random(7);
  for (const auto mode : search_modes)
    for (const char* name : {"dense", "ties", "rods_mixed", "touching_lattice"}) {
      const auto boxes = box_set<TypeParam>(name).make(700, 1);
      const Pairs truth = brute_force(boxes);
      for (int round = 0; round < 4; ++round) {
        std::vector<std::uint32_t> order(boxes.size());
        std::iota(order.begin(), order.end(), 0u);
        random.shuffle(order);
        detail::WorldCore<TypeParam> world({}, mode);
        for (const std::uint32_t i : order) world.create(boxes[i], {}, i);
        world.update();
        Pairs found;
        world.for_each_pair([&](ProxyPair pair) {
          const auto a = static_cast<std::uint32_t>(world.user(pair.a)),
                     b = static_cast<std::uint32_t>(world.user(pair.b));
          found.push_back({std::min(a, b), std::max(a, b)});
          return true;
        });
        ASSERT_TRUE(expect_same_pairs(found, truth, boxes, name, 1));
      }
    }
}

}  // namespace
}  // namespace boxstream::tests
