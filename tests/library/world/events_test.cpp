// SPDX-License-Identifier: MIT
// What updates say about pairs, case by case.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <boxstream/world.hpp>

#include "values.hpp"
#include "world/core.hpp"

namespace boxstream::tests {

template <class S>
class Events : public ::testing::Test {
 public:
  using Box = BasicAabb<S>;
  static Box cube(S x, S side = 1) { return {{x, x, x}, {x + side, x + side, x + side}}; }
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Events, Scalars);

TYPED_TEST(Events, TouchingCountsAndOneUlpApartDoesNot) {
  using S = TypeParam;
  BasicWorld<S> world;
  const ProxyId a = world.create(this->cube(0));
  const ProxyId b = world.create(this->cube(1));
  EXPECT_EQ(world.update().begun, 1u);
  auto apart = this->cube(1);
  apart.min[2] = std::nextafter(S(1), S(2));
  world.move(b, apart);
  EXPECT_EQ(world.update().ended, 1u);
  world.move(b, this->cube(1));
  world.update();
  ASSERT_EQ(world.begun().size(), 1u);
  EXPECT_EQ(world.begun()[0].a, a);
  EXPECT_EQ(world.begun()[0].b, b);
}

TYPED_TEST(Events, WhatIsToldNeedsNoBox) {
  using S = TypeParam;
  BasicWorld<S> world;
  std::vector<ProxyId> ids;
  for (int i = 0; i < 200; ++i) ids.push_back(world.create(this->cube(S(2 * i))));
  world.update();
  const ProxyPair one{ids[7], ids[3]}, other{ids[3], ids[4]}, stale{ids[3], ProxyId{}};
  const ProxyPair begin[] = {one, other, one, stale};
  std::vector<ProxyPair> asked;
  const auto accept = [&](ProxyId a, ProxyId b) {
    asked.push_back({a, b});
    return b == ids[7];
  };
  const WorldStats stats = world.update_told(begin, {}, accept);
  EXPECT_EQ(stats.begun, 1u);
  EXPECT_EQ(stats.pairs, 1u);
  ASSERT_EQ(asked.size(), 2u);  // in order
  EXPECT_EQ(asked[0].b, ids[4]);
  ASSERT_EQ(world.begun().size(), 1u);
  EXPECT_EQ(world.begun()[0].a, ids[3]);
  EXPECT_EQ(world.begun()[0].b, ids[7]);
  EXPECT_FALSE(world.begin_told(ids[7], ids[3]));
  EXPECT_TRUE(world.begin_told(ids[5], ids[6]));
  const ProxyPair end[] = {one, other};
  EXPECT_EQ(world.update_told({}, end, accept).ended, 1u);
  EXPECT_EQ(world.changes().removed[0], 0u);
  EXPECT_EQ(world.pair_count(), 1u);
  // The next search is by boxes again, of those that have moved.
  world.move(ids[5], this->cube(S(10.5)));
  EXPECT_EQ(world.update().ended, 1u);
  EXPECT_EQ(world.pair_count(), 0u);
  world.validate();
}

/// A few at a time, so that most pairs stay where they are, and now and then many.
TYPED_TEST(Events, WhatIsToldIsSpliced) {
  using S = TypeParam;
  BasicWorld<S> world;
  std::vector<ProxyId> ids;
  for (int i = 0; i < 60; ++i) ids.push_back(world.create(this->cube(S(2 * i))));
  world.update();
  using Places = std::pair<std::size_t, std::size_t>;
  std::vector<Places> held, next;
  std::mt19937 random(5);
  const auto any = [&] {
    const std::size_t a = random() % (ids.size() - 1);
    return Places(a, a + 1 + random() % (ids.size() - 1 - a));
  };
  const auto accept = [](ProxyId, ProxyId) { return true; };
  const auto pair_of = [&](const Places& places) { return ProxyPair{ids[places.first], ids[places.second]}; };
  for (int update = 0; update < 400; ++update) {
    std::vector<ProxyPair> begin, end;
    next = held;
    const std::size_t count = update % 50 == 49 ? 300 : random() % 5;
    for (std::size_t i = 0; i < count; ++i) {
      const Places places = random() % 3 == 0 && !held.empty() ? held[random() % held.size()] : any();
      const bool is_held = std::binary_search(held.begin(), held.end(), places);
      const auto place = std::lower_bound(next.begin(), next.end(), places);
      const bool is_next = place != next.end() && *place == places;
      (is_held ? end : begin).push_back(pair_of(places));
      if (is_held && is_next) next.erase(place);
      if (!is_held && !is_next) next.insert(place, places);
    }
    world.update_told(begin, end, accept);
    const Splice changes = world.changes();
    std::vector<Places> spliced = held;
    splice(spliced, changes);
    for (const std::uint32_t place : changes.inserted) spliced[place] = next[place];
    ASSERT_EQ(spliced, next) << update;
    for (std::size_t i = 0; i < next.size(); ++i) {
      const ProxyPair pair = pair_of(next[i]);
      ASSERT_EQ(world.pair_place(pair.a, pair.b), i) << update;
    }
    held = next;
  }
  // A search by boxes finds that none touches.
  for (std::size_t i = 0; i < ids.size(); ++i) world.move(ids[i], this->cube(S(2 * i) + S(0.25)));
  EXPECT_EQ(world.update().ended, held.size());
  world.validate();
}

TYPED_TEST(Events, ARoomThatIsLentHolds) {
  using S = TypeParam;
  BasicWorld<S> world;
  std::vector<ProxyId> ids;
  for (int i = 0; i < 200; ++i) ids.push_back(world.create(this->cube(S(1.25) * S(i))));
  BasicAabb<S> outer{}, inner{};
  for (int i = 0; i < 4; ++i) {
    world.move(ids[50], this->cube(S(62.5) + S(i) / 64));
    EXPECT_FALSE(world.room(ids[50], outer, inner)) << "not up to date";
    world.update();
  }
  ASSERT_TRUE(world.room(ids[50], outer, inner));
  EXPECT_FALSE(world.room(ids[51], outer, inner));
  ASSERT_TRUE(world.room(ids[50], outer, inner));
  for (const bool is_far : {false, true}) {
    auto box = outer;
    if (is_far)
      for (int d = 0; d < 3; ++d) box.max[d] = std::nextafter(outer.max[d], S(1000));
    world.move(ids[50], box);
    EXPECT_EQ(world.update().begun, is_far ? 1u : 0u);
  }
}

TYPED_TEST(Events, InvalidBoxIsInertUntilRepaired) {
  using S = TypeParam;
  BasicWorld<S> world;
  const auto good = this->cube(0);
  const ProxyId a = world.create(good);
  const ProxyId b = world.create(good);
  world.update();
  auto bad = good;
  bad.max[1] = std::numeric_limits<S>::quiet_NaN();
  world.move(a, bad);
  auto stats = world.update();
  EXPECT_EQ(stats.ended, 1u);
  EXPECT_EQ(stats.invalid, 1u);
  int found = 0;
  world.query_box(good, [&](ProxyId id) {
    EXPECT_EQ(id, b);
    return ++found > 0;
  });
  EXPECT_EQ(found, 1);
  bad = good;
  std::swap(bad.min[0], bad.max[0]);
  world.move(a, bad);
  EXPECT_EQ(world.update().begun, 0u);
  world.move(a, good);
  stats = world.update();
  EXPECT_EQ(stats.begun, 1u);
  EXPECT_EQ(stats.invalid, 0u);
}

TYPED_TEST(Events, NothingMovedMeansNothingSearched) {
  using S = TypeParam;
  BasicWorld<S> world;
  const auto box = this->cube(0);
  const ProxyId a = world.create(box);
  world.create(box);
  world.update();
  auto minus = box;
  minus.min[0] = -S(0);
  world.move(a, box);
  world.move(a, minus);
  EXPECT_TRUE(std::signbit(world.box(a).min[0])) << "the box given last, sign of zero included";
  world.set_filter(a, {});
  const auto stats = world.update();
  EXPECT_EQ(stats.moved, 0u);
  EXPECT_EQ(stats.pairs, 1u);
  EXPECT_EQ(stats.search.boxes, 0u);
  EXPECT_TRUE(world.begun().empty());
  EXPECT_TRUE(world.ended().empty());
}

TYPED_TEST(Events, LeavingAndComingBackBetweenUpdatesIsNoEvent) {
  BasicWorld<TypeParam> world;
  const ProxyId a = world.create(this->cube(0));
  world.create(this->cube(0));
  world.update();
  world.move(a, this->cube(50));
  world.move(a, this->cube(0));
  const auto stats = world.update();
  EXPECT_EQ(stats.moved, 1u);
  EXPECT_EQ(stats.begun + stats.ended, 0u);
}

TYPED_TEST(Events, FilterChangeEndsPairsUnlessSticky) {
  for (const bool sticky : {false, true}) {
    WorldOptions options;
    options.sticky_filters = sticky;
    BasicWorld<TypeParam> world(options);
    const ProxyId a = world.create(this->cube(0));
    const ProxyId b = world.create(this->cube(0));
    world.update();
    world.set_filter(b, {1, 0});
    EXPECT_EQ(world.update().ended, sticky ? 0u : 1u);
    world.move(a, this->cube(50));
    EXPECT_EQ(world.update().ended, sticky ? 1u : 0u);
    world.move(a, this->cube(0));
    EXPECT_EQ(world.update().begun, 0u);
    world.set_filter(b, {});
    EXPECT_EQ(world.update().begun, 1u);
  }
}

/// However pairs are looked for, and while others move.
TYPED_TEST(Events, RefusedPairIsAskedAboutAgainOnlyAfterAChange) {
  using S = TypeParam;
  for (const auto mode : {detail::SearchMode::probe, detail::SearchMode::all, detail::SearchMode::candidates}) {
    detail::WorldCore<S> world(WorldOptions{}, mode);
    const ProxyId a = world.create(this->cube(0), Filter{}, 0);
    const ProxyId b = world.create(this->cube(0), Filter{}, 0);
    const ProxyId other = world.create(this->cube(9), Filter{}, 0);
    int asked = 0;
    const auto refuse = [&](ProxyId, ProxyId) { return ++asked < 0; };
    const auto questions = [&](int frame) {
      world.move(other, this->cube(S(10 + frame)));
      const int before = asked;
      EXPECT_EQ(world.update(refuse).pairs, 0u);
      world.validate();
      return asked - before;
    };
    EXPECT_EQ(questions(0), 1);
    EXPECT_EQ(questions(1), 0);
    world.move(a, this->cube(0));
    EXPECT_EQ(questions(2), 0) << "the same box";
    world.move(a, this->cube(S(0.5)));
    EXPECT_EQ(questions(3), 1);
    EXPECT_EQ(questions(4), 0);
    world.set_filter(b, {3, ~0u});
    EXPECT_EQ(questions(5), 1);
    EXPECT_EQ(questions(6), 0);
    EXPECT_TRUE(world.refilter(b));
    EXPECT_EQ(questions(7), 1);
    world.refilter();
    EXPECT_EQ(questions(8), 1);
    EXPECT_EQ(questions(9), 0);
    EXPECT_FALSE(world.release(a, b));
    EXPECT_EQ(questions(10), 1);
    EXPECT_EQ(questions(11), 0);
    world.move(other, this->cube(30));
    EXPECT_EQ(world.update().begun, 0u) << "not without a filter either";
    world.refilter();
    EXPECT_EQ(world.update([](ProxyId, ProxyId) { return true; }).begun, 1u);
    asked = 0;
    world.move(a, this->cube(0));
    EXPECT_EQ(world.update(refuse).pairs, 1u);
    EXPECT_EQ(asked, 0) << "a held pair is not asked about";
  }
}

TYPED_TEST(Events, ReleasedPairBeginsOnceMore) {
  BasicWorld<TypeParam> world;
  const ProxyId a = world.create(this->cube(0));
  const ProxyId b = world.create(this->cube(0));
  world.update();
  EXPECT_TRUE(world.release(b, a));
  EXPECT_FALSE(world.release(a, b));
  EXPECT_EQ(world.pair_count(), 0u);
  const auto stats = world.update();
  EXPECT_EQ(stats.begun, 1u);
  EXPECT_EQ(stats.ended, 0u);
  world.release(a, b);
  world.move(a, this->cube(50));
  EXPECT_EQ(world.update().begun, 0u);
  EXPECT_TRUE(world.ended().empty());
}

TYPED_TEST(Events, EagerPairIsNotReportedAgainButItsEndIs) {
  BasicWorld<TypeParam> world;
  const ProxyId a = world.create(this->cube(0));
  const ProxyId b = world.create(this->cube(0));
  int begun = 0;
  const auto yes = [](ProxyId, ProxyId) { return true; };
  const auto count = [&](ProxyPair p) {
    EXPECT_EQ(p.a, a);
    EXPECT_EQ(p.b, b);
    ++begun;
  };
  world.begin_pairs_of(b, yes, count);
  world.begin_pairs_of(a, yes, count);
  EXPECT_EQ(begun, 1);
  EXPECT_EQ(world.pair_count(), 1u);
  EXPECT_EQ(world.update().begun, 0u);
  EXPECT_EQ(world.pair_count(), 1u);
  world.move(a, this->cube(50));
  EXPECT_EQ(world.update().ended, 1u);
}

/// One that was never a candidate: its boxes were apart when candidates were looked for, and are again.
TYPED_TEST(Events, EagerPairEndsHoweverPairsAreLookedFor) {
  using S = TypeParam;
  for (const auto mode : {detail::SearchMode::probe, detail::SearchMode::all, detail::SearchMode::candidates}) {
    detail::WorldCore<S> world(WorldOptions{}, mode);
    world.create(this->cube(0), Filter{}, 0);
    const ProxyId b = world.create(this->cube(10), Filter{}, 0);
    ASSERT_EQ(world.update().pairs, 0u);
    world.move(b, this->cube(0));
    world.begin_pairs_of(
        b, [](ProxyId, ProxyId) { return true; }, [](ProxyPair) {});
    ASSERT_EQ(world.pair_count(), 1u);
    world.move(b, this->cube(10));
    const WorldStats stats = world.update();
    EXPECT_EQ(stats.ended, 1u);
    EXPECT_EQ(stats.pairs, 0u);
    ASSERT_NO_THROW(world.validate());
  }
}

TYPED_TEST(Events, ManyEagerPairsAndReleasesBetweenUpdates) {
  // More than the side lists hold before they are folded.
  BasicWorld<TypeParam> world;
  std::vector<ProxyId> ids;
  for (int i = 0; i < 90; ++i) ids.push_back(world.create(this->cube(0)));
  for (const ProxyId id : ids)
    world.begin_pairs_of(
        id, [](ProxyId, ProxyId) { return true; }, [](ProxyPair) {});
  EXPECT_EQ(world.pair_count(), 90u * 89 / 2);
  world.validate();
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (std::size_t j = i + 1; j < ids.size(); j += 2) EXPECT_TRUE(world.release(ids[i], ids[j]));
  const std::uint64_t left = world.pair_count();
  world.validate();
  EXPECT_EQ(world.update().begun, 90u * 89 / 2 - left);
  EXPECT_EQ(world.pair_count(), 90u * 89 / 2);
  world.validate();
}

// Everything made at one point, then moved apart before the first update.
TYPED_TEST(Events, ThreeThousandAtOnePointThenMoved) {
  using S = TypeParam;
  BasicWorld<S> world;
  std::vector<ProxyId> ids;
  for (int i = 0; i < 3000; ++i) ids.push_back(world.create(this->cube(0)));
  int found = 0;
  world.query_box(this->cube(0), [&](ProxyId) { return ++found > 0; });
  EXPECT_EQ(found, 3000);
  for (int i = 0; i < 3000; ++i) world.move(ids[static_cast<unsigned>(i)], this->cube(S(3 * i)));
  EXPECT_EQ(world.update().pairs, 0u);
  found = 0;
  world.query_box(this->cube(0), [&](ProxyId) { return ++found > 0; });
  EXPECT_EQ(found, 1);
  world.validate();
  for (const ProxyId id : ids) world.move(id, this->cube(0));
  EXPECT_EQ(world.update().begun, 3000ull * 2999 / 2);
  for (const ProxyId id : ids) world.destroy(id);
  EXPECT_EQ(world.update().ended, 3000ull * 2999 / 2);
  EXPECT_EQ(world.pair_count(), 0u);
  world.validate();
}

TYPED_TEST(Events, ThrowingCallbackLeavesTheWorldAsItWas) {
  BasicWorld<TypeParam> world;
  std::vector<ProxyId> ids;
  for (int i = 0; i < 40; ++i) ids.push_back(world.create(this->cube(TypeParam(i))));
  world.update();
  const std::uint64_t before = world.pair_count();
  for (const ProxyId id : ids) world.move(id, this->cube(0));
  world.destroy(ids[7]);
  for (int fatal = 1; fatal < 300; fatal += 50) {
    int asked = 0;
    EXPECT_THROW(world.update([&](ProxyId, ProxyId) {
      if (++asked == fatal) throw std::runtime_error("no");
      return true;
    }),
                 std::runtime_error);
    EXPECT_EQ(world.pair_count(), before);
    world.validate();
  }
  const auto stats = world.update();
  EXPECT_EQ(stats.pairs, 39u * 38 / 2);
  EXPECT_EQ(stats.ended, 2u) << "of the destroyed one with its two neighbours";
}

// However pairs are looked for: an update that would begin too many throws, and has changed nothing.
TYPED_TEST(Events, UpdateBeyondTheLimitOfBegunPairsChangesNothing) {
  using S = TypeParam;
  for (const auto mode : {detail::SearchMode::probe, detail::SearchMode::all, detail::SearchMode::candidates}) {
    detail::WorldCore<S> world(WorldOptions{}, mode);
    std::vector<ProxyId> ids;
    for (int i = 0; i < 60; ++i) ids.push_back(world.create(this->cube(S(i) * 2), Filter{}, 0));
    ids.push_back(world.create(this->cube(0), Filter{}, 0));
    ASSERT_EQ(world.update().begun, 1u);
    world.set_max_begun(100);
    for (int i = 1; i < 60; ++i) world.move(ids[static_cast<std::size_t>(i)], this->cube(0));
    for (int again = 0; again < 2; ++again) {
      EXPECT_THROW(world.update(), std::length_error);
      EXPECT_EQ(world.pair_count(), 1u);
      EXPECT_EQ(world.begun().size(), 1u);
      ASSERT_NO_THROW(world.validate());
    }
    world.set_max_begun(61 * 60 / 2 - 1);
    EXPECT_EQ(world.update().begun, 61u * 60 / 2 - 1);
    ASSERT_NO_THROW(world.validate());
  }
}

TYPED_TEST(Events, ReleasedPairsCountForTheLimitOfBegunPairs) {
  using S = TypeParam;
  for (const int boxes : {10, 1000}) {
    BasicWorld<S> world;
    std::vector<ProxyId> ids;
    for (int i = 0; i < boxes; ++i) ids.push_back(world.create(this->cube(S(std::max(i - 1, 0)) * 2)));
    ASSERT_EQ(world.update().begun, 1u);
    ASSERT_TRUE(world.release(ids[0], ids[1]));
    world.set_max_begun(0);
    EXPECT_THROW(world.update(), std::length_error) << boxes;
    world.set_max_begun(1);
    EXPECT_EQ(world.update().begun, 1u) << boxes;
  }
}

TYPED_TEST(Events, CallbacksOfUpdateMayQuery) {
  BasicWorld<TypeParam> world;
  for (int i = 0; i < 50; ++i) world.create(this->cube(TypeParam(i)));
  std::uint64_t found = 0;
  world.update([&](ProxyId a, ProxyId) {
    world.query_box(world.box(a), [&](ProxyId) { return ++found > 0; });
    return true;
  });
  EXPECT_EQ(found, 49u * 3 - 1) << "the first of each pair meets itself and its neighbours";
}

/// Runs tasks on real threads, the last ones first.
class BackwardThreads : public Executor {
 public:
  explicit BackwardThreads(unsigned threads) : threads_(threads) {}
  unsigned concurrency() const override { return threads_; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    std::vector<std::thread> crew;
    for (unsigned t = 0; t < threads_; ++t)
      crew.emplace_back([this, count, task, t] {
        for (std::size_t i = count; i-- > 0;)
          if (i % threads_ == t) task(i);
      });
    for (std::thread& thread : crew) thread.join();
  }

 private:
  unsigned threads_;
};

TYPED_TEST(Events, SameEventsOnAnyExecutor) {
  using S = TypeParam;
  const auto run = [](Executor* executor) {
    WorldOptions options;
    options.executor = executor;
    BasicWorld<S> world(options);
    std::mt19937 random(5);
    std::uniform_real_distribution<S> place(0, 30);
    const auto anywhere = [&]() -> BasicAabb<S> {
      const S x = place(random);
      const S y = place(random);
      const S z = place(random);
      return {{x, y, z}, {x + S(0.7), y + S(0.7), z + S(0.7)}};
    };
    std::vector<ProxyId> ids;
    std::vector<ProxyId> log;
    for (int i = 0; i < 20000; ++i) ids.push_back(world.create(anywhere()));
    for (int frame = 0; frame < 3; ++frame) {
      world.update();
      for (const ProxyPair p : world.begun()) log.insert(log.end(), {p.a, p.b});
      for (const ProxyPair p : world.ended()) log.insert(log.end(), {p.b, p.a});
      for (std::size_t i = 0; i < ids.size(); i += frame == 0 ? 1 : 9) world.move(ids[i], anywhere());
    }
    return log;
  };
  const auto serial = run(nullptr);
  EXPECT_GT(serial.size(), 1000u);
  for (unsigned threads = 1; threads <= 4; ++threads) {
    BackwardThreads executor(threads);
    EXPECT_TRUE(run(&executor) == serial) << threads << " threads";
  }
}

}  // namespace boxstream::tests
