// SPDX-License-Identifier: MIT
// Names of proxies: what they mean, for how long, and when they come again.
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <boxstream/world.hpp>

#include "values.hpp"
#include "world/state/proxies.hpp"

namespace boxstream::tests {

constexpr Aabb unit{{0, 0, 0}, {1, 1, 1}};

TEST(Ids, NullIdNamesNothing) {
  World world;
  world.create(unit);
  EXPECT_FALSE(ProxyId{});
  EXPECT_FALSE(world.contains({}));
  EXPECT_FALSE(world.move({}, unit));
  EXPECT_FALSE(world.set_filter({}, {}));
  EXPECT_FALSE(world.set_user({}, 1));
  EXPECT_FALSE(world.release({}, {}));
  EXPECT_FALSE(world.destroy(ProxyId{}));
  EXPECT_FALSE(is_valid(world.box({})));
  EXPECT_EQ(world.filter({}).mask, 0u);
  EXPECT_EQ(world.user({}), 0u);
}

TEST(Ids, WhatTheUserKeepsWithAProxyCanBeReplaced) {
  World world;
  const ProxyId first = world.create(unit, {}, 1), second = world.create(unit, {}, 2);
  EXPECT_TRUE(world.set_user(first, 7));
  EXPECT_EQ(world.user(first), 7u);
  EXPECT_EQ(world.user(second), 2u);
}

TEST(Ids, StaleIdIsRejectedAfterItsSlotIsUsedAgain) {
  World world;
  const ProxyId first = world.create(unit, {}, 1);
  ASSERT_TRUE(world.destroy(first));
  const ProxyId second = world.create(unit, {}, 2);
  EXPECT_EQ(first.slot, second.slot);
  EXPECT_NE(first, second);
  EXPECT_FALSE(world.contains(first));
  EXPECT_FALSE(world.destroy(first));
  EXPECT_FALSE(world.move(first, unit));
  EXPECT_EQ(world.user(second), 2u);
  EXPECT_EQ(world.size(), 1u);
}

TEST(Ids, SlotIsRetiredWhenItsGenerationsAreUsedUp) {
  detail::ProxyTable<float> table(0xFFFFFFFEu);
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (int i = 0; i < 10; ++i) {
    table.reserve(1);
    const ProxyId id = table.create(unit, {}, 0);
    EXPECT_NE(id.generation, 0u);
    EXPECT_TRUE(seen.insert({id.slot, id.generation}).second) << "an id came back";
    table.destroy(table.rank(id));
    for (const auto& [slot, generation] : seen) EXPECT_EQ(table.rank({slot, generation}), table.none);
    table.validate();
  }
  EXPECT_EQ(table.slots(), 5u) << "two generations in each slot";
}

TEST(Ids, EventsOfDestroyedProxiesCarryTheStaleId) {
  World world;
  const ProxyId a = world.create(unit);
  const ProxyId b = world.create(unit);
  world.update();
  ASSERT_EQ(world.begun().size(), 1u);
  world.destroy(b);
  const ProxyId c = world.create(unit);
  const WorldStats stats = world.update();
  ASSERT_EQ(world.ended().size(), 1u);
  EXPECT_EQ(world.ended()[0].a, a);
  EXPECT_EQ(world.ended()[0].b, b);
  ASSERT_EQ(world.begun().size(), 1u);
  EXPECT_EQ(world.begun()[0].b, c);
  EXPECT_EQ(stats.pairs, 1u);
}

// A second run after clear() equals the first, ids and events included.
TEST(Ids, ClearedWorldRepeatsItsHistory) {
  World world;
  const auto run = [&world] {
    std::vector<std::uint32_t> log;
    std::vector<ProxyId> ids;
    for (unsigned i = 0; i < 300; ++i) {
      if (i % 5 == 3) {
        world.destroy(ids[i / 2]);
      }
      ids.push_back(world.create(box_from<float>(i)));
      log.insert(log.end(), {ids.back().slot, ids.back().generation});
      if (i % 40 == 39) {
        world.update();
        for (const ProxyPair p : world.begun())
          log.insert(log.end(), {p.a.slot, p.a.generation, p.b.slot, p.b.generation});
        for (const ProxyPair p : world.ended())
          log.insert(log.end(), {p.a.slot, p.a.generation, p.b.slot, p.b.generation});
      }
    }
    return log;
  };
  const auto first = run();
  world.set_max_begun(1);
  world.clear();
  EXPECT_EQ(world.size(), 0u);
  EXPECT_EQ(world.pair_count(), 0u);
  EXPECT_FALSE(is_valid(world.bounds()));
  world.validate();
  EXPECT_EQ(run(), first);
}

// It does not know how boxes moved before.
TEST(Ids, ClearedWorldSearchesAsANewOne) {
  World world;
  const auto run = [&world] {
    std::vector<std::uint64_t> log;
    std::vector<ProxyId> ids;
    for (int i = 0; i < 3000; ++i) ids.push_back(world.create(Aabb{{float(i), 0, 0}, {float(i) + 1.5f, 1, 1}}));
    for (int frame = 0; frame < 12; ++frame) {
      const float x = float(frame) / 512;
      for (int i = 0; i < 3000; ++i) world.move(ids[std::size_t(i)], {{float(i) + x, 0, 0}, {float(i) + 1.5f, 1, 1}});
      const WorldStats stats = world.update();
      log.insert(log.end(), {stats.search.tests, stats.search.cells, stats.pairs});
    }
    return log;
  };
  const auto first = run();
  world.clear();
  EXPECT_EQ(run(), first);
}

TEST(Ids, BulkCallsRejectSpansOfDifferentLength) {
  World world;
  const std::vector<Aabb> boxes(3, unit);
  const std::vector<Filter> filters(2);
  const std::vector<std::uint64_t> users(4);
  std::vector<ProxyId> ids(3), two_ids(2);
  EXPECT_THROW(world.create(boxes, filters, ids), std::invalid_argument);
  EXPECT_THROW(world.create(boxes, {}, two_ids), std::invalid_argument);
  EXPECT_THROW(world.create(boxes, {}, ids, users), std::invalid_argument);
  EXPECT_EQ(world.size(), 0u);
  world.create(boxes, {}, ids);
  EXPECT_EQ(world.size(), 3u);
  EXPECT_EQ(world.user(ids[2]), 0u);
  EXPECT_THROW(world.move(two_ids, boxes), std::invalid_argument);
}

// Bulk calls name proxies as single ones would, free slots first.
TEST(Ids, BulkCreationGivesTheIdsOfSingleCreations) {
  World one_by_one, at_once;
  std::vector<ProxyId> expected, made(50), more(50);
  for (int i = 0; i < 50; ++i) expected.push_back(one_by_one.create(unit));
  at_once.create(std::vector<Aabb>(50, unit), {}, made);
  EXPECT_EQ(made, expected);
  const std::vector<ProxyId> leaving{made[7], made[3], made[7], made[40]};
  for (const ProxyId id : leaving) one_by_one.destroy(id);
  EXPECT_EQ(at_once.destroy(leaving), 3u);
  expected.clear();
  for (int i = 0; i < 50; ++i) expected.push_back(one_by_one.create(unit));
  at_once.create(std::vector<Aabb>(50, unit), {}, more);
  EXPECT_EQ(more, expected);
}

TEST(Ids, MovedWorldKeepsItsProxies) {
  World world;
  const ProxyId id = world.create(unit, {}, 7);
  World other = std::move(world);
  EXPECT_EQ(other.user(id), 7u);
  World third;
  third = std::move(other);
  EXPECT_EQ(third.user(id), 7u);
}

TEST(Ids, ComingAndGoingWithoutUpdatesTakesNoMemory) {
  detail::ProxyTable<float> table;
  // What WorldCore does around the table: compaction as soon as the table asks for it.
  for (int i = 0; i < 100000; ++i) {
    if (table.needs_compaction()) table.compact([](std::uint32_t) { return false; });
    table.reserve(1);
    table.destroy(table.rank(table.create(unit, {}, 0)));
  }
  EXPECT_LT(table.ranks(), 100u);
  EXPECT_EQ(table.slots(), 1u);
}

}  // namespace boxstream::tests
