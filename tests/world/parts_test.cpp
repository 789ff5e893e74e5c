// SPDX-License-Identifier: MIT
// Parts of a World that histories of small worlds do not reach.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "world_core.hpp"
#include "world_pairs.hpp"

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

Aabb cube(int i) {
  const auto x = static_cast<float>(i % 30);
  const auto y = static_cast<float>(i / 30 % 30);
  const auto z = static_cast<float>(i / 900);
  return {{x, y, z}, {x + 1, y + 1, z + 1}};
}

// Cost follows change: who moves decides what is searched.
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
  EXPECT_EQ(move(3000), 30000u) << "some against all";
  EXPECT_EQ(move(27000), 27000u);
  for (int frame = 0; frame < 40; ++frame) move(5);
  EXPECT_EQ(move(5), 0u) << "few ask the index once it has paid off to bring it up to date";
}

}  // namespace boxstream::tests
