// SPDX-License-Identifier: MIT
// Tests of the test data: a box set that is not what it says would make every test that uses it prove nothing.
#include <algorithm>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "fast_oracle.hpp"
#include "same_pairs.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class BoxSets : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BoxSets, Scalars);

TYPED_TEST(BoxSets, HaveTheSizeDensityAndValidityTheyClaim) {
  for (const auto& set : box_sets<TypeParam>()) {
    SCOPED_TRACE(set.name);
    const auto boxes = set.make(std::min<std::size_t>(2000, set.largest), 1);
    EXPECT_EQ(boxes.size(), std::min<std::size_t>(2000, set.largest));
    EXPECT_EQ(count_invalid(boxes) != 0, set.has_invalid);
    const std::size_t pairs = brute_force(boxes).size();
    EXPECT_GE(pairs, set.fewest_pairs);
    EXPECT_LE(pairs, set.most_pairs);
    EXPECT_GT(set.fewest_pairs, 0u);
    EXPECT_TRUE(set.make(0, 1).empty());
    EXPECT_EQ(set.make(1, 1).size(), 1u);
  }
}

TYPED_TEST(BoxSets, SweepOracleAgreesWithBruteForce) {
  for (const auto& set : box_sets<TypeParam>()) {
    const auto a = set.make(std::min<std::size_t>(1500, set.largest), 2);
    const auto b = set.make(std::min<std::size_t>(400, set.largest), 3);
    expect_same_pairs(sweep(a), brute_force(a), a, set.name, 2);
    expect_same_pairs(sweep(a, b), brute_force(a, b), a, b, set.name, 2);
  }
}

TEST(Oracle, NamesTheFirstDifference) {
  const Boxes<float> boxes(3, {{0, 0, 0}, {1, 1, 1}});
  const Pairs truth = brute_force(boxes);
  ASSERT_EQ(truth, (Pairs{{0, 1}, {0, 2}, {1, 2}}));
  EXPECT_EQ(first_difference({{1, 2}, {0, 1}, {0, 2}}, truth, boxes, boxes), "");
  const auto kind = [&](const Pairs& found) {
    const std::string text = first_difference(found, truth, boxes, boxes);
    return text.substr(0, text.find(';'));
  };
  EXPECT_EQ(kind({}), "missing pair (0, 1)");
  EXPECT_EQ(kind({{0, 1}, {1, 2}}), "missing pair (0, 2)");
  EXPECT_EQ(kind({{0, 1}, {0, 2}}), "missing pair (1, 2)");
  EXPECT_EQ(kind({{0, 1}, {0, 1}, {0, 2}, {1, 2}}), "duplicate pair (0, 1)");
  EXPECT_EQ(kind({{0, 1}, {0, 2}, {1, 2}, {1, 2}}), "duplicate pair (1, 2)");
  EXPECT_EQ(kind({{0, 1}, {0, 2}, {1, 0}, {1, 2}}), "extra pair (1, 0)");
}

}  // namespace
}  // namespace boxstream::tests
