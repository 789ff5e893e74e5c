// SPDX-License-Identifier: MIT
//
// Neighbours of each box, compared with what a caller would make of the pairs.

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "executors.hpp"
#include "oracle.hpp"

namespace boxstream::tests {
namespace {

using Rows = std::vector<std::vector<std::uint32_t>>;

Rows rows_of(const Pairs& pairs, std::size_t boxes, bool both) {
  Rows rows(boxes);
  for (const Pair pair : pairs) {
    rows[pair.a].push_back(pair.b);
    if (both) rows[pair.b].push_back(pair.a);
  }
  for (auto& row : rows) std::sort(row.begin(), row.end());
  return rows;
}

Rows rows_of(const Neighbours& neighbours) {
  EXPECT_FALSE(neighbours.offsets.empty());
  EXPECT_EQ(neighbours.offsets.front(), 0u);
  EXPECT_EQ(neighbours.offsets.back(), neighbours.indices.size());
  Rows rows(neighbours.offsets.size() - 1);
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i].assign(neighbours.indices.begin() + static_cast<std::ptrdiff_t>(neighbours.offsets[i]),
                   neighbours.indices.begin() + static_cast<std::ptrdiff_t>(neighbours.offsets[i + 1]));
  return rows;
}

template <class S>
class NeighboursOf : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(NeighboursOf, Scalars);

TYPED_TEST(NeighboursOf, EachBoxOfEachFamily) {
  ThreadExecutor threads(3);
  Detector alone, shared({&threads});
  Neighbours found;
  for (const auto& set : box_sets_to_repeat<TypeParam>())
    for (const std::size_t n : {0, 1, 2, 64, 300, 2100}) {
      const auto a = set.make(std::min(n, set.largest), n), b = set.make(std::min(n / 3, set.largest), n + 1);
      for (Detector* detector : {&alone, &shared}) {
        const Pairs pairs = brute_force(a);
        EXPECT_EQ(detector->find_neighbours(a, found).pairs, pairs.size());
        EXPECT_EQ(rows_of(found), rows_of(pairs, a.size(), true)) << set.name << ' ' << n;
        detector->find_neighbours(a, found, {}, Directions::one);
        EXPECT_EQ(rows_of(found), rows_of(pairs, a.size(), false)) << set.name << ' ' << n;
        detector->find_neighbours(a, b, found);
        EXPECT_EQ(rows_of(found), rows_of(brute_force(a, b), a.size(), false)) << set.name << ' ' << n;
      }
    }
}

/// More pairs than are kept in one piece; rows of each length about which sorting changes its way.
TYPED_TEST(NeighboursOf, RowsOfEachLength) {
  Detector detector;
  Neighbours found;
  for (const std::size_t n : {3, 4, 5, 6, 90, 97, 98, 99, 130, 400}) {
    const Boxes<TypeParam> a(n, {{0, 0, 0}, {1, 1, 1}});
    detector.find_neighbours(a, found);
    EXPECT_EQ(rows_of(found), rows_of(brute_force(a), n, true)) << n;
    detector.find_neighbours(a, found, {}, Directions::one);
    EXPECT_EQ(rows_of(found), rows_of(brute_force(a), n, false)) << n;
  }
}

TYPED_TEST(NeighboursOf, BoxesByRules) {
  const auto boxes = box_set<TypeParam>("touching_lattice").make(1500, 1);
  PairRules rules;
  rules.touching = false;
  Detector detector;
  Neighbours found;
  Pairs pairs;
  detector.find_pairs(boxes, pairs, rules);
  detector.find_neighbours(boxes, found, rules);
  EXPECT_EQ(rows_of(found), rows_of(pairs, boxes.size(), true));
  rules.tolerance = -1;
  EXPECT_THROW(detector.find_neighbours(boxes, found, rules), std::invalid_argument);
  EXPECT_TRUE(found.offsets.empty());
  EXPECT_TRUE(found.indices.empty());
}

}  // namespace
}  // namespace boxstream::tests
