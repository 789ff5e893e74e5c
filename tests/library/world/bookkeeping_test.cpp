// SPDX-License-Identifier: MIT
// What a World writes down between updates, where random histories seldom come.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "core/executors.hpp"
#include "core/oracle.hpp"
#include "watched_world.hpp"
#include "world/core.hpp"

namespace boxstream::tests {
namespace {

using World = detail::WorldCore<float>;
using detail::SearchMode;

/// In a row along x, each touching its neighbours; or apart.
Aabb in_row(std::size_t i, bool apart = false) {
  const auto x = static_cast<float>(i) * (apart ? 3.0f : 1.0f);
  return {{x, 0, 0}, {x + 1, 1, 1}};
}

std::vector<Aabb> row(std::size_t n, bool apart = false) {
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < n; ++i) boxes.push_back(in_row(i, apart));
  return boxes;
}

std::vector<ProxyId> create(World& world, const std::vector<Aabb>& boxes) {
  std::vector<ProxyId> ids(boxes.size());
  world.create(boxes, {}, ids, {});
  return ids;
}

std::size_t begun_at_once(World& world, ProxyId id) {
  std::size_t count = 0;
  world.begin_pairs_of(
      id, [](ProxyId, ProxyId) { return true; }, [&](ProxyPair) { ++count; });
  return count;
}

TEST(Bookkeeping, AReleasedPairThatFiltersRefuseDoesNotBeginAgain) {
  WorldOptions sticky;
  sticky.sticky_filters = true;
  for (const SearchMode mode : {SearchMode::probe, SearchMode::all, SearchMode::candidates}) {
    World world(sticky, mode);
    const auto ids = create(world, row(2));
    world.update();
    world.set_filter(ids[0], {0, 0});
    world.update();
    EXPECT_EQ(world.pair_count(), 1u) << "filters are sticky";
    EXPECT_TRUE(world.release(ids[0], ids[1]));
    world.update();
    EXPECT_EQ(world.pair_count(), 0u);
    EXPECT_TRUE(world.begun().empty());
  }
}

TEST(Bookkeeping, AStickyPairThatPartsDoesNotBeginAgain) {
  WorldOptions sticky;
  sticky.sticky_filters = true;
  for (const SearchMode mode : {SearchMode::probe, SearchMode::all, SearchMode::candidates}) {
    World world(sticky, mode);
    const auto box = [](float x) { return Aabb{{x, 0, 0}, {x + 1, 1, 1}}; };
    const ProxyId still = world.create(box(0)), other = world.create(box(0.95f));
    world.update();
    world.set_filter(other, {0, 0});
    world.update();
    EXPECT_EQ(world.pair_count(), 1u);
    for (const float x : {1.02f, 0.97f, 1.01f, 0.96f}) {
      world.move(other, box(x));
      world.update();
      EXPECT_EQ(world.pair_count(), 0u) << x;
    }
    EXPECT_TRUE(world.contains(still));
  }
}

TEST(Bookkeeping, AReleasedPairMayBeginBeforeTheNextUpdate) {
  World world;
  const auto ids = create(world, row(2));
  world.update();
  EXPECT_TRUE(world.release(ids[0], ids[1]));
  EXPECT_EQ(begun_at_once(world, ids[0]), 1u);
  EXPECT_EQ(world.pair_count(), 1u);
  world.validate();
}

TEST(Bookkeeping, AReleasedPairIsAskedAboutAfterOthersAreGone) {
  World world;
  auto boxes = row(200, true);
  boxes.push_back(boxes.back());
  const auto ids = create(world, boxes);
  world.update();
  ASSERT_EQ(world.pair_count(), 1u);
  EXPECT_TRUE(world.release(ids[199], ids[200]));
  world.destroy(Span<const ProxyId>(ids.data(), 150));
  create(world, {in_row(1000, true)});  // tombstones are dropped to make room
  world.update();
  ASSERT_EQ(world.begun().size(), 1u);
  EXPECT_EQ(world.begun()[0].a, ids[199]);
}

TEST(Bookkeeping, MovesInRowsAreCountedAndSkipTheDead) {
  World world;
  const auto ids = create(world, row(256, true));
  world.update();
  EXPECT_EQ(world.move(ids, row(256)), 256u);
  EXPECT_EQ(world.update().moved, 255u) << "the first one stays";
  world.destroy(ids[100]);
  EXPECT_EQ(world.move(ids, row(256, true)), 255u);
  world.update();
  EXPECT_EQ(world.pair_count(), 0u);
  world.validate();
}

TEST(Bookkeeping, AStreamOfPairsStopsWhileSomeAreReleased) {
  World world;
  const auto ids = create(world, row(2000));
  world.update();
  world.release(ids[0], ids[1]);
  int calls = 0;
  world.stream_pairs([&](Span<const ProxyPair>) { return ++calls < 2; });
  EXPECT_EQ(calls, 2);
}

TEST(Bookkeeping, PartsOfAParallelUpdateStartEmpty) {
  InlineExecutor executor(4);
  WorldOptions options;
  options.executor = &executor;
  World world(options, SearchMode::probe);
  const auto ids = create(world, row(6000));
  world.update();
  EXPECT_EQ(world.pair_count(), 5999u);
  world.move(ids, row(6000, true));
  world.update();
  EXPECT_EQ(world.pair_count(), 0u);
}

TEST(Bookkeeping, TheLimitOfBegunPairsHoldsInEachWayOfSearching) {
  for (const SearchMode mode : {SearchMode::probe, SearchMode::all, SearchMode::candidates}) {
    World world({}, mode);
    create(world, row(3));
    world.set_max_begun(1);
    EXPECT_THROW(world.update(), std::length_error);
    EXPECT_EQ(world.pair_count(), 0u);
    world.set_max_begun(2);
    EXPECT_EQ(world.update().begun, 2u);
  }
}

/// Not in the first update alone, where there are no fat boxes yet.
TEST(Bookkeeping, TheLimitOfBegunPairsHoldsForCandidates) {
  for (const SearchMode mode : {SearchMode::probe, SearchMode::all, SearchMode::candidates}) {
    World world({}, mode);
    std::vector<ProxyId> ids;
    const auto box = [](int i, float pitch) {
      const float x = pitch * static_cast<float>(i);
      return Aabb{{x, 0, 0}, {x + 1, 1, 1}};
    };
    for (int i = 0; i < 3; ++i) ids.push_back(world.create(box(i, 1.03f)));
    for (const float pitch : {1.03f, 1.02f, 1.01f}) {
      for (int i = 0; i < 3; ++i) world.move(ids[static_cast<std::size_t>(i)], box(i, pitch));
      EXPECT_EQ(world.update().begun, 0u);
    }
    for (int i = 0; i < 3; ++i) world.move(ids[static_cast<std::size_t>(i)], box(i, 1));
    world.set_max_begun(1);
    EXPECT_THROW(world.update(), std::length_error);
    EXPECT_EQ(world.pair_count(), 0u);
    world.set_max_begun(2);
    EXPECT_EQ(world.update().begun, 2u);
  }
}

/// Unit cubes face to face, in layers with a gap that closes and opens as every other one goes up and down by an eighth
/// of what all go down in a frame. A few stay where they are. Far from the origin, sums are rounded.
std::vector<Aabb> falling(int now, float offset) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < 1200; ++i) {
    const int frame = i % 200 == 7 ? 0 : now;
    const auto x = static_cast<float>(i % 10), z = static_cast<float>(i / 10 % 10);
    const auto layer = static_cast<float>(i / 100);
    const auto y = offset - 2 * static_cast<float>(frame) + 1.25f * layer +
                   (i / 100 % 2 == 0 ? 0.25f * static_cast<float>(frame % 2) : 0);
    boxes.push_back({{x, y, z}, {x + 1, y + 1, z + 1}});
  }
  return boxes;
}

TEST(Bookkeeping, AWorldThatMovesAsAWholeStaysInItsFatBoxes) {
  for (const float offset : {0.0f, 262144.0f, 2097152.0f})
    for (const SearchMode mode : {SearchMode::candidates, SearchMode::cheapest}) {
      WatchedWorld<float> watched(mode);
      watched.create(falling(0, offset));
      watched.update();
      int searches = 0;
      std::size_t changes = 0;
      for (int frame = 1; frame <= 60; ++frame) {
        const auto boxes = falling(frame, offset);
        for (std::uint32_t i = 0; i < boxes.size(); ++i) watched.move(i, boxes[i]);
        const WorldStats stats = watched.update();
        searches += stats.search.tests != 0;
        changes += static_cast<std::size_t>(stats.begun);
        if (HasFailure()) return;
      }
      // Out there a margin is hardly wider than what sums are rounded by, and fat boxes need not pay.
      if (offset < 1e6f) {
        EXPECT_LT(searches, 30) << "offset " << offset << ", mode " << int(mode);
      }
      EXPECT_GT(changes, 60u);
    }
}

// A box that reaches to infinity has no fat box that could be moved along.
TEST(Bookkeeping, ABoxWithoutEndJoinsAWorldThatMovesAsAWhole) {
  WatchedWorld<float> watched(SearchMode::candidates);
  watched.create(falling(0, 0));
  watched.update();
  for (int frame = 1; frame <= 40 && !HasFailure(); ++frame) {
    auto boxes = falling(frame, 0);
    constexpr float inf = std::numeric_limits<float>::infinity();
    if (frame > 20) boxes[7] = {{-inf, boxes[7].min[1], -inf}, {inf, boxes[7].max[1], inf}};
    for (std::uint32_t i = 0; i < boxes.size(); ++i) watched.move(i, boxes[i]);
    watched.update();
  }
}

// Pairs of boxes that tremble are soon taken for granted. Those that shrink stay inside their fat boxes and part all
// the same.
TEST(Candidates, PartInsideTheirFatBoxes) {
  constexpr std::size_t count = 200;
  for (const bool falls : {false, true}) {
    World world({}, SearchMode::candidates);
    std::vector<Aabb> boxes(count);
    std::vector<ProxyId> ids;
    for (int update = 0; update < 100; ++update) {
      // On one side only, for what all lower sides have in common is followed.
      const float side = update < 20 ? 1 : 1 - 0.008f * static_cast<float>(update - 20);
      const float fallen = falls ? 0.05f * static_cast<float>(update) : 0;
      for (std::size_t i = 0; i < count; ++i) {
        const float x =
            0.6f * static_cast<float>(i) + 0.0002f * static_cast<float>((i + i / 12 + std::size_t(update)) % 3);
        boxes[i] = {{x, -fallen, 0}, {x + side, side - fallen, side}};
      }
      if (update == 0)
        ids = create(world, boxes);
      else
        world.move(ids, boxes);
      world.update();
      std::uint64_t expected = 0;
      for (std::size_t i = 0; i + 1 < count; ++i) expected += touch(boxes[i], boxes[i + 1]);
      ASSERT_EQ(world.pair_count(), expected) << "update " << update;
      world.validate();
    }
    EXPECT_EQ(world.pair_count(), 0u);
  }
}

// A pair that another search began is not among the candidates. When it ends in its fat boxes, it has to become one.
TEST(Candidates, BeginAgainAfterAPairOfAnotherSearchHasEnded) {
  for (const bool followed : {false, true}) {
    WatchedWorld<float> watched(SearchMode::candidates);
    watched.create({{{0, 0, 0}, {1, 1, 1}}, {{1.05f, 0, 0}, {2.05f, 1, 1}}});
    watched.update();
    const auto move_to = [&](float x, SearchMode mode) {
      watched.world().force(mode);
      watched.move(1, {{x, 0, 0}, {x + 1, 1, 1}});
      return watched.update().pairs;
    };
    EXPECT_EQ(move_to(0.99f, SearchMode::probe), 1u);
    EXPECT_EQ(move_to(1.05f, followed ? SearchMode::candidates : SearchMode::all), 0u);
    EXPECT_EQ(move_to(0.99f, SearchMode::candidates), 1u);
  }
}

}  // namespace
}  // namespace boxstream::tests
