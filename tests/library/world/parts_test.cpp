// SPDX-License-Identifier: MIT
// Parts of a World that histories of small worlds do not reach.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "values.hpp"
#include "world/core.hpp"
#include "world/state/compare.hpp"
#include "world/state/pairs.hpp"

namespace boxstream::tests {

TEST(PairSorter, SortsAnyNumberOfPairsAmongAnyNumberOfRanks) {
  std::mt19937 random(7);
  detail::PairSorter sorter;
  std::vector<detail::PairKey> sorted;
  for (const std::size_t ranks : {2u, 3u, 1000u, 1024u, 1025u, 1u << 20, (1u << 20) + 1, 0xFFFFFFFEu})
    for (const std::size_t count : {0u, 1u, 255u, 256u, 5000u}) {
      std::vector<Pair> pairs;
      std::vector<detail::PairKey> expected;
      while (pairs.size() < count) {
        const auto a = static_cast<std::uint32_t>(random() % ranks);
        const auto b = static_cast<std::uint32_t>(random() % ranks);
        if (a == b) continue;
        pairs.push_back({std::min(a, b), std::max(a, b)});
        expected.push_back(detail::pair_key(a, b));
      }
      std::sort(expected.begin(), expected.end());
      sorter.sort(pairs, ranks, sorted);
      ASSERT_EQ(sorted, expected) << count << " pairs among " << ranks;
    }
}

/// Pairs among some ranks, each with this chance, in no order.
std::vector<Pair> random_pairs(std::mt19937& engine, std::uint32_t ranks, unsigned one_in) {
  std::vector<Pair> pairs;
  for (std::uint32_t b = 1; b < ranks; ++b)
    for (std::uint32_t a = 0; a < b; ++a)
      if (engine() % one_in == 0) pairs.push_back({a, b});
  std::shuffle(pairs.begin(), pairs.end(), engine);
  return pairs;
}

/// Lists, and what an update of them says.
struct Updated {
  detail::PairLists lists;
  std::vector<detail::PairKey> begun, ended;
  std::vector<std::uint32_t> begun_places, ended_places;

  /// The way of searches of all that find few pairs.
  void merge(Span<const Pair> found) {
    lists.merge(found, begun, begun_places, ended, ended_places);
    lists.take_merged();
  }
  /// That of all others.
  void exchange(Span<const Pair> found, std::uint32_t ranks) {
    lists.expect_all();
    finish(found, ranks);
  }
  void finish(Span<const Pair> found, std::uint32_t ranks) {
    detail::PairSorter sorter;
    std::vector<Pair> fresh;
    lists.confirm(found, detail::UpdateThreads(nullptr), fresh);
    sorter.sort(fresh, ranks, begun);
    ended.clear();
    const auto is_gone = [&](detail::PairKey key) {
      ended.push_back(key);
      return true;
    };
    lists.find_missing(is_gone, ended_places);
    lists.exchange(ended_places, begun, begun_places);
  }
};

TEST(PairLists, MergedAreThoseExchanged) {
  std::mt19937 engine(7);
  for (const std::uint32_t ranks : {2u, 3u, 20u, 70u, 300u}) {
    Updated merged, exchanged;
    merged.lists.reserve_ranks(ranks);
    exchanged.lists.reserve_ranks(ranks);
    std::vector<Pair> found;
    for (int update = 0; update < 30; ++update) {
      if (update % 3 != 1) found = random_pairs(engine, ranks, update % 4 == 0 ? 3 : ranks);
      if (update % 3 == 2 && !found.empty()) found.pop_back();
      merged.merge(found);
      exchanged.exchange(found, ranks);
      ASSERT_EQ(merged.begun, exchanged.begun);
      ASSERT_EQ(merged.ended, exchanged.ended);
      ASSERT_EQ(merged.begun_places, exchanged.begun_places);
      ASSERT_EQ(merged.ended_places, exchanged.ended_places);
      ASSERT_EQ(merged.lists.size(), found.size());
      merged.lists.validate();
    }
  }
}

TEST(PairLists, ThoseOfAFewRanksAreExpected) {
  constexpr std::uint32_t ranks = 90;
  std::mt19937 engine(8);
  Updated of;
  of.lists.reserve_ranks(ranks);
  const std::vector<Pair> pairs = random_pairs(engine, ranks, 4);
  of.exchange(pairs, ranks);
  for (std::uint32_t listed = 1; listed <= 12; ++listed) {
    std::vector<std::uint32_t> few;
    for (std::uint32_t i = 0; i < listed; ++i) few.push_back(ranks - 1 - 7 * i);
    std::size_t expected = 0;
    for (const Pair pair : pairs)
      expected += std::count(few.begin(), few.end(), pair.a) + std::count(few.begin(), few.end(), pair.b) > 0;
    of.lists.expect_of(few);
    std::size_t missing = 0;
    std::vector<std::uint32_t> places;
    of.lists.find_missing([&](detail::PairKey) { return ++missing > 0; }, places);
    ASSERT_EQ(missing, expected) << listed;
  }
}

template <class S>
class CompareGroups : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CompareGroups, Scalars);

TYPED_TEST(CompareGroups, SeesWhatChangedAndWhatIsInvalid) {
  using Box = BasicAabb<TypeParam>;
  std::mt19937 random(11);
  for (int round = 0; round < 3000; ++round) {
    const std::size_t groups = 1 + random() % 4;
    const std::size_t count = groups * detail::compared_group;
    std::vector<Box> old, now;
    for (std::size_t i = 0; i < count; ++i) {
      old.push_back(box_from<TypeParam>(random()));
      now.push_back(random() % 2 == 0 ? old.back() : box_from<TypeParam>(random()));
      // Few enough invalid ones that all are valid at times.
      if (!is_valid(now.back()) && random() % 32 != 0) now.back() = {{0, 0, 0}, {1, 1, 1}};
    }
    std::vector<std::uint64_t> changed(groups);
    const bool all_valid = detail::compare_groups(old.data(), now.data(), groups, changed.data());
    EXPECT_EQ(all_valid, std::all_of(now.begin(), now.end(), [](const Box& box) { return is_valid(box); }));
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_valid(old[i]) || !is_valid(now[i])) continue;
      const std::size_t bit = 6 * (i % detail::compared_group);
      ASSERT_EQ((changed[i / detail::compared_group] >> bit & 1) == 0, old[i] == now[i]) << "box " << i;
    }
    for (const std::uint64_t group : changed) EXPECT_EQ(group & ~detail::whole_group, 0u);
  }
}

Aabb cube(int i) {
  const auto x = static_cast<float>(i % 30);
  const auto y = static_cast<float>(i / 30 % 30);
  const auto z = static_cast<float>(i / 900);
  return {{x, y, z}, {x + 1, y + 1, z + 1}};
}

// Cost follows change: what moves decides what is searched.
TEST(SearchMode, FollowsHowManyMove) {
  World world;
  std::vector<ProxyId> ids;
  for (int i = 0; i < 27000; ++i) ids.push_back(world.create(cube(i)));
  EXPECT_EQ(world.update().search.boxes, 27000u) << "all are new: one batch";
  EXPECT_EQ(world.update().search.boxes, 0u) << "none moved: no search";

  const auto move = [&](std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = i * 37 % ids.size();
      Aabb box = world.box(ids[k]);
      box.max[0] += 0.001f;
      world.move(ids[k], box);
    }
    return world.update().search.boxes;
  };
  EXPECT_EQ(move(27000), 27000u);
  for (int frame = 0; frame < 120; ++frame) move(5);
  EXPECT_EQ(move(5), 0u) << "few ask the index once it has paid off to bring it up to date";
}

// The first few that move in a world at rest wait neither for an index nor for all others.
TEST(SearchMode, AFewThatBeginToMoveAreComparedWithAll) {
  World world;
  std::vector<ProxyId> ids;
  for (int i = 0; i < 1000; ++i) ids.push_back(world.create(cube(i)));
  world.update();
  const std::uint64_t pairs = world.pair_count();
  for (std::size_t frame = 0; frame < 3; ++frame) {  // another one each time: one that goes on moving gets a room
    const ProxyId id = ids[500 + frame];
    Aabb box = world.box(id);
    box.max[0] += 0.001f;
    world.move(id, box);
    EXPECT_EQ(world.update().search.boxes, 1001u);
    EXPECT_EQ(world.pair_count(), pairs);
  }
}

// The index is built while what moves is compared with all; what moves in between is in it in the end.
TEST(SearchMode, WhatMovesWhileAnIndexIsBuiltIsFound) {
  World world;
  std::vector<ProxyId> ids;
  for (int i = 0; i < 1000; ++i) {
    Aabb box = cube(i);
    for (int d = 0; d < 3; ++d) box.max[d] = box.min[d] + 0.5f;
    ids.push_back(world.create(box));
  }
  ASSERT_EQ(world.update().begun, 0u);
  bool was_beside = false, was_probe = false;
  for (std::size_t i = 0; i < 300; ++i) {
    const auto x = static_cast<float>(1000 + i);
    world.move(ids[i], {{x, 0, 0}, {x + 1, 1, 1}});
    const WorldStats stats = world.update();
    ASSERT_EQ(stats.begun, i == 0 ? 0u : 1u) << "box " << i << " touches the one before";
    (stats.search.boxes == 0 ? was_probe : was_beside) = true;
  }
  EXPECT_TRUE(was_beside && was_probe);
}

/// A query brings the present tree up to date, and not the one that the next update finishes.
TEST(SearchMode, ATreeThatAnUpdateFinishesAfterAQueryIsUpToDate) {
  const auto at = [](std::size_t x, float y) {
    const auto left = static_cast<float>(x);
    return Aabb{{left, y, 0}, {left + 1, y + 1, 1}};
  };
  World world;
  const auto found = [&](const Aabb& box) {
    std::size_t count = 0;
    world.query_box(box, [&](ProxyId) { return ++count != 0; });
    return count;
  };
  std::vector<ProxyId> ids;
  for (std::size_t i = 0; i < 1000; ++i) ids.push_back(world.create(at(3 * i, 0)));
  world.update();
  ASSERT_EQ(found(at(0, 0)), 1u);
  // So many that there is no place for them, but they can be looked through.
  for (std::size_t i = 0; i < 100; ++i) world.create(at(3 * i, 50));
  ASSERT_EQ(found(at(0, 50)), 1u);
  world.update();
  for (std::size_t frame = 0; frame < 600; ++frame) {
    const Aabb box = at(10000 + 10 * frame, 500);
    world.move(ids[0], box);
    world.move(ids[1], box);
    ASSERT_EQ(found(box), 2u) << frame;
    world.update();
    ASSERT_EQ(world.pair_count(), 1u) << frame;
    ASSERT_EQ(found(box), 2u) << frame;
    ASSERT_NO_THROW(world.validate()) << frame;
  }
}

/// The same of whatever comes between two updates, with trees that are begun, overtaken, finished and worn.
TEST(SearchMode, QueriesBetweenChangesAndUpdatesFindWhatThereIs) {
  std::mt19937 engine(11);
  const auto number = [&](unsigned below) { return engine() % below; };
  const auto box = [&] {
    Aabb one{};
    for (int d = 0; d < 3; ++d) {
      one.min[d] = static_cast<float>(number(2000)) / 100;
      one.max[d] = one.min[d] + static_cast<float>(number(100)) / 100;
    }
    return one;
  };
  World world;
  std::vector<std::pair<ProxyId, Aabb>> live;
  const auto create = [&] {
    const Aabb one = box();
    live.emplace_back(world.create(one), one);
  };
  while (live.size() < 700) create();
  std::vector<Aabb> boxes;
  for (int frame = 0; frame < 1500; ++frame) {
    // Spells of few and of many changes, near and far.
    const unsigned spell = static_cast<unsigned>(frame) / 100;
    for (unsigned left = number(spell % 3 == 0 ? 4 : 20); left > 0; --left) {
      auto& [id, at] = live[number(static_cast<unsigned>(live.size()))];
      if (spell % 2 == 0) {
        at = box();
      } else {
        for (int d = 0; d < 3; ++d) at.max[d] += (at.max[d] - at.min[d]) / 8 + 0.01f;
      }
      world.move(id, at);
    }
    if (spell % 4 == 3 && number(3) == 0) {
      create();
      const std::size_t gone = number(static_cast<unsigned>(live.size()));
      world.destroy(live[gone].first);
      live.erase(live.begin() + static_cast<std::ptrdiff_t>(gone));
    }
    boxes.clear();
    for (const auto& each : live) boxes.push_back(each.second);
    if (number(2) == 0) {
      const Aabb asked = box();
      std::size_t found = 0;
      world.query_box(asked, [&](ProxyId) { return ++found != 0; });
      ASSERT_EQ(static_cast<std::ptrdiff_t>(found),
                std::count_if(boxes.begin(), boxes.end(), [&](const Aabb& b) { return overlaps(b, asked); }))
          << frame;
    }
    world.update();
    ASSERT_EQ(world.pair_count(), find_pairs(boxes).size()) << frame;
    if (frame % 50 == 0) {
      ASSERT_NO_THROW(world.validate()) << frame;
    }
  }
}

/// Boxes by slot that a tree is built of, while some change.
struct ChangingBoxes {
  explicit ChangingBoxes(std::size_t count) : engine(count), boxes(count) {
    for (Aabb& box : boxes) box = random();
  }
  Aabb random() {
    Aabb box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<float>(engine() % 1000);
      box.max[d] = box.min[d] + static_cast<float>(engine() % 20);
    }
    if (engine() % 8 == 0) box.max[0] = box.min[0] - 1;
    return box;
  }
  auto box_of() const {
    return [this](std::uint32_t slot) { return boxes[slot]; };
  }

  std::mt19937 engine;
  std::vector<Aabb> boxes;
};

TEST(Index, InPartsIsThatOfOneRefresh) {
  for (const std::size_t count : {1u, 8u, 9u, 64u, 65u, 600u, 5000u}) {
    const ChangingBoxes of(count);
    detail::Bvh<float> at_once(0), in_parts(0);
    at_once.reserve_slots(count);
    for (std::uint32_t slot = 0; slot < count; ++slot) at_once.mark(slot);
    at_once.refresh(of.box_of());
    in_parts.reserve_slots(count);
    in_parts.begin_build();
    std::size_t parts = 1;
    while (!in_parts.build_part(50, of.box_of())) ++parts;
    if (count >= 64) {
      EXPECT_GT(parts, count / 12);
    }
    in_parts.validate(of.box_of());
    ASSERT_EQ(at_once.tree_blocks(), in_parts.tree_blocks());
    for (std::size_t place = 0; place < 8 * at_once.tree_blocks(); ++place)
      ASSERT_EQ(at_once.slot_at(place), in_parts.slot_at(place));
  }
}

TEST(Index, InPartsTakesInWhatChangesMeanwhile) {
  ChangingBoxes of(2000);
  detail::Bvh<float> index;
  index.reserve_slots(of.boxes.size());
  index.begin_build();
  do {
    const auto slot = static_cast<std::uint32_t>(of.engine() % of.boxes.size());
    of.boxes[slot] = of.random();
    index.mark(slot);
    if (of.engine() % 4 != 0) continue;
    of.boxes.push_back(of.random());
    index.reserve_slots(of.boxes.size());
    index.mark(static_cast<std::uint32_t>(of.boxes.size() - 1));
  } while (!index.build_part(200, of.box_of()));
  index.refresh(of.box_of());
  EXPECT_NO_THROW(index.validate(of.box_of()));
}

/// Boxes of which a few others change between any two parts of a tree, so that small parts come too late.
struct ChangingProxies {
  explicit ChangingProxies(std::uint32_t count) : of(count) {
    table.reserve(count);
    for (const Aabb& box : of.boxes) table.create(box, {}, 0);
  }
  void change(std::size_t changes) {
    for (std::size_t i = 0; i < changes; ++i) {
      const auto rank = static_cast<std::uint32_t>(of.engine() % table.ranks());
      if (table.move(rank, of.random())) index.mark(table.id(rank).slot);
    }
  }
  /// How many parts it takes.
  std::size_t build(std::size_t changes) {
    for (std::size_t parts = 1;; ++parts) {
      change(changes);
      if (index.build_part(table, 20 * std::max<std::size_t>(1, changes), changes)) return parts;
      if (parts == 100000) return 0;
    }
  }

  ChangingBoxes of;
  detail::ProxyTable<float> table;
  detail::LazyIndex<float> index;
};

TEST(Index, IsMadeInTimeWhereverOthersChangeMeanwhile) {
  for (const std::uint32_t count : {385u, 1000u, 4000u})
    for (const std::size_t changes : {1u, 3u, 10u, 200u}) {
      SCOPED_TRACE(testing::Message() << count << " boxes, " << changes << " changes");
      ChangingProxies proxies(count);
      const std::size_t whole = detail::Bvh<float>::work_of_build(count) / (20 * changes);
      const std::size_t first = proxies.build(changes);
      ASSERT_NE(first, 0u);
      // Half of it again for parts that come too late, as for those that do not.
      EXPECT_LE(first, whole + whole / 2 + count);
      EXPECT_NO_THROW(proxies.index.validate(proxies.table));
    }
}

TEST(Index, MadeInAHurryIsMadeLessOftenEachTime) {
  ChangingProxies proxies(1000);
  std::size_t before = proxies.build(30);
  for (int again = 0; again < 3; ++again) {
    const std::size_t parts = proxies.build(30);
    EXPECT_GT(2 * parts, 3 * before) << again;
    EXPECT_LT(4 * parts, 9 * before + 400) << again;
    before = parts;
  }
  // One that small parts make is a new beginning.
  proxies.build(0);
  EXPECT_LT(2 * proxies.build(30), before);
}

template <class S>
class FatBoxEdge : public ::testing::Test {
 public:
  using Box = BasicAabb<S>;

  /// A box that has been told to a world that keeps candidates, and a point out on one of its six sides, which has no
  /// margin. `candidates` is whether the fat box of the box reaches the point.
  struct FatBoxSetting {
    explicit FatBoxSetting(int side, S point)
        : axis(side / 2), upper(side % 2 == 1), world({}, detail::SearchMode::candidates), id(world.create(box)) {
      Box at{{S(0.5), S(0.5), S(0.5)}, {S(0.5), S(0.5), S(0.5)}};
      at.min[axis] = at.max[axis] = upper ? point : -point;
      world.create(at);
      const WorldStats stats = world.update();
      EXPECT_EQ(stats.begun, 0u);
      candidates = stats.search.pairs;
    }

    void reach(S point) {
      (upper ? box.max : box.min)[axis] = upper ? point : -point;
      world.move(id, box);
    }

    int axis;
    bool upper;
    Box box{{-1, -1, -1}, {1, 1, 1}};
    detail::WorldCore<S> world;
    ProxyId id;
    std::uint64_t candidates;
  };
};
TYPED_TEST_SUITE(FatBoxEdge, Scalars);

// Wherever the fat box ends: one step beyond that, the box has left it.
TYPED_TEST(FatBoxEdge, OneUlpBeyondIsNoticed) {
  using S = TypeParam;
  using Setting = typename TestFixture::FatBoxSetting;
  for (int side = 0; side < 6; ++side) {
    S inside = std::nextafter(S(1), S(2)), outside = 2;
    ASSERT_EQ(Setting(side, inside).candidates, 1u);
    ASSERT_EQ(Setting(side, outside).candidates, 0u);
    while (std::nextafter(inside, outside) != outside) {
      const S middle = inside + (outside - inside) / 2;
      (Setting(side, middle).candidates != 0 ? inside : outside) = middle;
    }
    for (const S point : {inside, outside}) {
      Setting setting(side, point);
      setting.reach(point);
      EXPECT_EQ(setting.world.update().begun, 1u)
          << "side " << side << ", " << (point == inside ? "inside" : "outside");
    }
  }
}

}  // namespace boxstream::tests
