// SPDX-License-Identifier: MIT
// Regions tile space: each point is in one, and a box is given to those that it touches and no others.
#include "out_of_core/regions.hpp"

#include <cstddef>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "core/box_sets.hpp"

namespace boxstream::detail {
namespace {

using tests::box_sets;

std::vector<KeyBox<float>> keys(const tests::Boxes<float>& boxes) {
  std::vector<KeyBox<float>> all;
  for (const Aabb& box : boxes)
    if (has_valid_keys(box)) all.emplace_back(box);
  return all;
}

bool touches(const Region<float>& region, const KeyBox<float>& box) {
  for (int d = 0; d < 3; ++d)
    if (box.lo[d] > region.last[d] || box.hi[d] < region.first[d]) return false;
  return true;
}

TEST(Regions, AreTouchedByTheBoxesGivenToThem) {
  for (const auto& set : box_sets<float>()) {
    const auto boxes = set.make(std::min<std::size_t>(2000, set.largest), 1);
    const Regions<float> regions({}, keys(boxes), 100, 64);
    ASSERT_LE(regions.size(), 64u);
    for (const Aabb& box : boxes) {
      if (!has_valid_keys(box)) continue;
      std::set<std::size_t> given, truth;
      regions.for_each_touched(box, [&](std::size_t i) { EXPECT_TRUE(given.insert(i).second); });
      for (std::size_t i = 0; i < regions.size(); ++i)
        if (touches(regions[i], KeyBox<float>(box))) truth.insert(i);
      ASSERT_EQ(given, truth) << set.name;
      // The low corner of a box is in one region: the one before which it does not begin.
      std::size_t owners = 0;
      for (const std::size_t i : given) owners += regions[i].before(box) == 0 ? 1 : 0;
      ASSERT_EQ(owners, 1u) << set.name;
    }
  }
}

TEST(Regions, AreBalancedWhereBoxesAreSmall) {
  const auto boxes = tests::box_set<float>("sparse").make(20000, 1);
  const Regions<float> regions({}, keys(boxes), 1000, 256);
  std::vector<std::size_t> sizes(regions.size());
  for (const Aabb& box : boxes) regions.for_each_touched(box, [&](std::size_t i) { ++sizes[i]; });
  EXPECT_GE(regions.size(), 20u);
  for (const std::size_t size : sizes) EXPECT_TRUE(size > 400 && size <= 1000) << size;
}

TEST(Regions, OneWhereNothingSeparates) {
  const Regions<float> regions({}, keys(tests::Boxes<float>(500, {{0, 0, 0}, {1, 1, 1}})), 100, 64);
  EXPECT_EQ(regions.size(), 1u);
}

}  // namespace
}  // namespace boxstream::detail
