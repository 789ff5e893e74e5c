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
  for (int frame = 0; frame < 40; ++frame) move(5);
  EXPECT_EQ(move(5), 0u) << "few ask the index once it has paid off to bring it up to date";
}

// The first few that move in a world at rest wait neither for an index nor for all others.
TEST(SearchMode, AFewThatBeginToMoveAreComparedWithAll) {
  World world;
  std::vector<ProxyId> ids;
  for (int i = 0; i < 1000; ++i) ids.push_back(world.create(cube(i)));
  world.update();
  const std::uint64_t pairs = world.pair_count();
  for (int frame = 0; frame < 3; ++frame) {
    Aabb box = world.box(ids[500]);
    box.max[0] += 0.001f;
    world.move(ids[500], box);
    EXPECT_EQ(world.update().search.boxes, 1001u);
    EXPECT_EQ(world.pair_count(), pairs);
  }
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
