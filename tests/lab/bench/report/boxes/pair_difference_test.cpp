// SPDX-License-Identifier: MIT
#include "boxes/pair_difference.hpp"

#include <gtest/gtest.h>

#include "inputs/batches.hpp"
#include "peers/plain.hpp"

namespace boxstream::report {
namespace {

TEST(PairDifference, TellsMissedExtraAndDuplicates) {
  const std::vector<Pair> expected{{0, 1}, {0, 2}, {1, 5}, {3, 4}};
  const PairDifference difference = compare_pairs(expected, {{3, 4}, {0, 1}, {0, 1}, {0, 3}, {0, 1}, {7, 8}});
  EXPECT_EQ(difference.missed, 2u);
  EXPECT_EQ(difference.extra, 2u);
  EXPECT_EQ(difference.duplicates, 2u);
  EXPECT_EQ(difference.complaint(true), "2 pairs missed, 2 extra, 2 found again");
}

TEST(PairDifference, ComplainsOfExtraPairsWhereTheyAreNotAllowed) {
  const std::vector<Pair> none;
  const PairDifference extra = compare_pairs(none, {{0, 1}});
  EXPECT_EQ(extra.complaint(true), "");
  EXPECT_NE(extra.complaint(false), "");
  EXPECT_NE(compare_pairs(std::vector<Pair>{{0, 1}}, {}).complaint(true), "");
  EXPECT_EQ(compare_pairs(none, {}).complaint(false), "");
}

TEST(PairDifference, AddsUp) {
  PairDifference sum = compare_pairs(std::vector<Pair>{{0, 1}}, {});
  sum.add(compare_pairs(std::vector<Pair>{{0, 1}}, {{0, 1}, {0, 1}, {0, 2}}));
  EXPECT_EQ(sum.missed, 1u);
  EXPECT_EQ(sum.duplicates, 1u);
  EXPECT_EQ(sum.extra, 1u);
}

TEST(AllAgainstAll, LeavesInvalidBoxesOut) {
  const std::vector<Aabb64> boxes{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}, {{1, 1, 1}, {0, 0, 0}}};
  EXPECT_EQ(all_against_all(Span<const Aabb64>(boxes)), (std::vector<Pair>{{0, 1}}));
}

TEST(ReferencePairs, AgreeWithASweepOnEitherSideOfTheirLimit) {
  for (const std::size_t n : {2000, 20001}) {
    const std::vector<Aabb> boxes = batches::make("U", n, 1);
    std::vector<Pair> swept;
    bench::make_sweep()->find_pairs(boxes, swept);
    EXPECT_GT(swept.size(), 0u);
    EXPECT_EQ(compare_pairs(reference_pairs(boxes), swept).complaint(false), "") << n;
  }
}

}  // namespace
}  // namespace boxstream::report
