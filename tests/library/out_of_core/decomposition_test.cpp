// SPDX-License-Identifier: MIT
// Parts of space for processes: each pair is one's, all have about as much to do, and nothing but the sample decides.
#include <boxstream/decomposition.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/box_sets.hpp"

namespace boxstream::out_of_core_test {
namespace {

template <class S>
class Decompositions : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Decompositions, Scalars);

template <class S>
std::vector<std::size_t> touched(const BasicDecomposition<S>& parts, const BasicAabb<S>& box) {
  std::vector<std::size_t> touched;
  parts.for_each_touched(box, [&](std::size_t part) { touched.push_back(part); });
  return touched;
}

TYPED_TEST(Decompositions, EachPairIsOfOnePart) {
  for (const auto& set : tests::box_sets<TypeParam>()) {
    const auto boxes = set.make(std::min<std::size_t>(400, set.largest), 1);
    const BasicDecomposition<TypeParam> parts(boxes, 7);
    for (const Pair pair : tests::brute_force(boxes)) {
      const auto of_a = touched(parts, boxes[pair.a]), of_b = touched(parts, boxes[pair.b]);
      std::size_t owners = 0;
      for (const std::size_t part : of_a)
        if (std::count(of_b.begin(), of_b.end(), part) != 0 &&
            (parts.before(part, boxes[pair.a]) & parts.before(part, boxes[pair.b])) == 0)
          ++owners;
      ASSERT_EQ(owners, 1u) << set.name << " " << pair.a << " " << pair.b;
    }
  }
}

TYPED_TEST(Decompositions, PartsAreTouchedByAboutEquallyManyBoxes) {
  for (const char* name : {"sparse", "rods_mixed", "clusters", "layer"}) {
    const auto boxes = tests::box_set<TypeParam>(name).make(30000, 1);
    for (const std::size_t count : {2, 3, 5, 12, 31}) {
      const BasicDecomposition<TypeParam> parts(boxes, count);
      ASSERT_EQ(parts.size(), count) << name;
      std::vector<std::size_t> sizes(count);
      for (const auto& box : boxes) parts.for_each_touched(box, [&](std::size_t part) { ++sizes[part]; });
      const std::size_t all = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
      EXPECT_LT(*std::max_element(sizes.begin(), sizes.end()) * count * 10, all * 11) << name << " " << count;
    }
  }
}

TYPED_TEST(Decompositions, OrderOfTheSampleDoesNotMatter) {
  auto boxes = tests::box_set<TypeParam>("six_decades").make(3000, 1);
  const BasicDecomposition<TypeParam> one(boxes, 13);
  std::reverse(boxes.begin(), boxes.end());
  const BasicDecomposition<TypeParam> other(boxes, 13);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t part = 0; part < one.size(); ++part) EXPECT_EQ(one.bounds(part), other.bounds(part));
}

TYPED_TEST(Decompositions, AreMoved) {
  const auto boxes = tests::box_set<TypeParam>("six_decades").make(3000, 1);
  const BasicDecomposition<TypeParam> expected(boxes, 13);
  BasicDecomposition<TypeParam> source(boxes, 13), one(std::move(source)), other(boxes, 2);
  EXPECT_EQ(one.size(), expected.size());
  other = std::move(one);
  ASSERT_EQ(other.size(), expected.size());
  for (std::size_t part = 0; part < other.size(); ++part) EXPECT_EQ(other.bounds(part), expected.bounds(part));
}

TYPED_TEST(Decompositions, BoundsShareFacesAndFillSpace) {
  constexpr TypeParam inf = std::numeric_limits<TypeParam>::infinity();
  const std::vector<BasicAabb<TypeParam>> boxes{{{-4, 0, 0}, {-3, 1, 1}}, {{5, 0, 0}, {6, 1, 1}}};
  const BasicDecomposition<TypeParam> parts(boxes, 2);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts.bounds(0), (BasicAabb<TypeParam>{{-inf, -inf, -inf}, {5, inf, inf}}));
  EXPECT_EQ(parts.bounds(1), (BasicAabb<TypeParam>{{5, -inf, -inf}, {inf, inf, inf}}));
}

/// Three of five columns lie below 3, two below 2: the least place with half of the boxes below it is 3.
TYPED_TEST(Decompositions, BoxesThatBeginAtACutAreNotBelowIt) {
  std::vector<BasicAabb<TypeParam>> columns;
  for (int i = 0; i < 500; ++i) {
    const auto x = static_cast<TypeParam>(i % 5);
    columns.push_back({{x, 0, 0}, {x + TypeParam(0.5), 1, 1}});
  }
  const BasicDecomposition<TypeParam> parts(columns, 2);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts.bounds(0).max[0], 3);
}

TYPED_TEST(Decompositions, OnePartWhereNothingSeparates) {
  const std::vector<BasicAabb<TypeParam>> equal(100, {{0, 0, 0}, {1, 1, 1}}), none;
  for (const std::size_t count : {1, 2, 3, 8}) {
    EXPECT_EQ(BasicDecomposition<TypeParam>(equal, count).size(), 1u);
    EXPECT_EQ(BasicDecomposition<TypeParam>(none, count).size(), 1u);
  }
}

TYPED_TEST(Decompositions, InvalidBoxesTouchNothing) {
  const auto boxes = tests::box_set<TypeParam>("invalid_among_valid").make(500, 1);
  const BasicDecomposition<TypeParam> parts(boxes, 5);
  std::size_t untouching = 0;
  for (const auto& box : boxes) untouching += touched(parts, box).empty() ? 1 : 0;
  EXPECT_GT(untouching, 0u);
  EXPECT_EQ(untouching, tests::count_invalid(boxes));
}

TEST(Decompositions, SamplesHaveTheSizeWantedWhateverTheIds) {
  for (const std::uint64_t stride : {1u, 2u, 1024u, 1u << 31})
    for (const std::size_t parts : {1, 10}) {
      std::size_t sampled = 0;
      for (std::uint64_t i = 0; i < 100000; ++i) sampled += is_sampled(i * stride, 100000, parts) ? 1 : 0;
      EXPECT_GT(sampled, 450 * parts) << stride;
      EXPECT_LT(sampled, 600 * parts) << stride;
    }
  EXPECT_TRUE(is_sampled(7, 500, 1));
  EXPECT_TRUE(is_sampled(7, 0, 1));
}

}  // namespace
}  // namespace boxstream::out_of_core_test
