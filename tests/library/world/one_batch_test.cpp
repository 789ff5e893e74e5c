// SPDX-License-Identifier: MIT
// Several things that happen to one proxy, or to two, between two updates.
#include <gtest/gtest.h>

#include <vector>

#include "core/box_sets.hpp"
#include "core/random.hpp"
#include "watched_world.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class OneBatch : public testing::Test {
 protected:
  using Box = BasicAabb<S>;
  static Box cube(S x) { return {{x, 0, 0}, {x + 1, 1, 1}}; }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(OneBatch, Scalars);

TYPED_TEST(OneBatch, OfAnIdNamedTwiceTheLastBoxCounts) {
  using S = TypeParam;
  for (const auto mode : search_modes) {
    detail::WorldCore<S> world({}, mode);
    const ProxyId a = world.create(this->cube(0)), b = world.create(this->cube(50));
    world.update();
    const std::vector<ProxyId> ids = {b, a, b, b};
    const std::vector<BasicAabb<S>> boxes = {this->cube(0), this->cube(0), this->cube(90), this->cube(S(0.5))};
    EXPECT_EQ(world.move(Span<const ProxyId>(ids), Span<const BasicAabb<S>>(boxes)), 4u);
    ASSERT_NO_THROW(world.validate());
    EXPECT_TRUE(world.box(b) == this->cube(S(0.5)));
    const WorldStats stats = world.update();
    EXPECT_EQ(stats.moved, 1u);
    EXPECT_EQ(stats.begun, 1u);
    EXPECT_EQ(world.destroy(Span<const ProxyId>(ids)), 2u) << "the second time an id is stale";
    ASSERT_NO_THROW(world.validate());
    EXPECT_EQ(world.update().ended, 1u);
  }
}

TYPED_TEST(OneBatch, WhatIsMadeMovedAndDestroyedLeavesNoTrace) {
  using S = TypeParam;
  for (const auto mode : search_modes) {
    detail::WorldCore<S> world({}, mode);
    world.create(this->cube(0));
    world.update();
    std::vector<ProxyId> gone;
    for (int i = 0; i < 50; ++i) {
      gone.push_back(world.create(this->cube(0)));
      EXPECT_TRUE(world.move(gone.back(), this->cube(S(0.5))));
      EXPECT_TRUE(world.set_filter(gone.back(), {2, ~0u}));
      EXPECT_TRUE(world.destroy(gone.back()));
      ASSERT_NO_THROW(world.validate());
    }
    const WorldStats stats = world.update();
    EXPECT_EQ(stats.proxies, 1u);
    EXPECT_EQ(stats.begun + stats.ended, 0u);
    for (const ProxyId id : gone) EXPECT_FALSE(world.contains(id));
    ASSERT_NO_THROW(world.validate());
  }
}

/// The move is forgotten, the pairs from before it end, and the next proxy in the slot inherits nothing.
TYPED_TEST(OneBatch, DestroyedWhileItsMoveIsPending) {
  using S = TypeParam;
  for (const auto mode : search_modes) {
    detail::WorldCore<S> world({}, mode);
    const ProxyId a = world.create(this->cube(0)), b = world.create(this->cube(0)), c = world.create(this->cube(50));
    world.update();
    EXPECT_TRUE(world.move(a, this->cube(50)));
    EXPECT_TRUE(world.destroy(a));
    ASSERT_NO_THROW(world.validate());
    EXPECT_FALSE(world.move(a, this->cube(50)));
    const ProxyId heir = world.create(this->cube(90));
    EXPECT_EQ(heir.slot, a.slot);
    const WorldStats stats = world.update();
    EXPECT_EQ(stats.moved, 1u) << "the heir alone";
    EXPECT_EQ(stats.begun, 0u);
    ASSERT_EQ(world.ended().size(), 1u);
    EXPECT_EQ(world.ended()[0].a, a);
    EXPECT_EQ(world.ended()[0].b, b);
    EXPECT_EQ(stats.pairs, 0u);
    EXPECT_TRUE(world.contains(c));
    ASSERT_NO_THROW(world.validate());
  }
}

/// What began and ended is the difference of the two frames, as WatchedWorld says after each.
TYPED_TEST(OneBatch, BoxesThatChangePlaces) {
  using S = TypeParam;
  Random random(3);
  for (const auto mode : search_modes) {
    auto boxes = box_set<S>("dense").make(300, 4);
    WatchedWorld<S> watched(mode);
    watched.create(boxes);
    watched.update();
    for (int frame = 0; frame < 12; ++frame) {
      for (int swap = 0; swap < 1 + frame * 4; ++swap) {
        const auto i = static_cast<std::uint32_t>(random.index(300)), j = static_cast<std::uint32_t>(random.index(300));
        std::swap(boxes[i], boxes[j]);
        watched.move(i, boxes[i]);
        watched.move(j, boxes[j]);
      }
      watched.update();
      ASSERT_FALSE(this->HasFailure());
    }
  }
}

TYPED_TEST(OneBatch, TwoThatOverlapAndChangePlacesAreNoEvent) {
  using S = TypeParam;
  for (const auto mode : search_modes) {
    detail::WorldCore<S> world({}, mode);
    const ProxyId a = world.create(this->cube(0)), b = world.create(this->cube(S(0.5)));
    const ProxyId left = world.create(this->cube(S(-0.75))), right = world.create(this->cube(S(1.25)));
    ASSERT_EQ(world.update().begun, 3u);
    world.move(a, this->cube(S(0.5)));
    world.move(b, this->cube(0));
    const WorldStats stats = world.update();
    ASSERT_EQ(stats.begun, 2u);
    ASSERT_EQ(stats.ended, 2u);
    EXPECT_EQ(world.begun()[0].a, a);
    EXPECT_EQ(world.begun()[0].b, right);
    EXPECT_EQ(world.begun()[1].a, b);
    EXPECT_EQ(world.begun()[1].b, left);
    EXPECT_EQ(world.ended()[0].b, left);
    EXPECT_EQ(world.ended()[1].b, right);
    EXPECT_EQ(world.pair_count(), 3u);
  }
}

}  // namespace
}  // namespace boxstream::tests
