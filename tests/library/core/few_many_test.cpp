// SPDX-License-Identifier: MIT
// Two sets of unequal size: few boxes compared with all of the other set, block by block.
#include <algorithm>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "checks.hpp"
#include "executors.hpp"
#include "random.hpp"
#include "same_pairs.hpp"

namespace boxstream::tests {
namespace {

/// Boxes of every kind: points, touching ones, coinciding ones, with infinite sides, inverted, with a NaN.
template <class S>
Boxes<S> mixed_boxes(std::size_t n, std::uint64_t seed) {
  constexpr S infinity = std::numeric_limits<S>::infinity(), nan = std::numeric_limits<S>::quiet_NaN();
  Random random(seed);
  Boxes<S> boxes(n);
  for (BasicAabb<S>& box : boxes) {
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<S>(random.index(12)) - 6;
      box.max[d] = box.min[d] + static_cast<S>(random.index(3));
    }
    const int axis = static_cast<int>(random.index(3));
    switch (random.index(20)) {
      case 0:
        std::swap(box.min[axis], box.max[axis]);
        break;
      case 1:
        (random.index(2) == 0 ? box.min : box.max)[axis] = random.index(2) == 0 ? nan : -nan;
        break;
      case 2:
        box.min[axis] = -infinity;
        break;
      case 3:
        box.max[axis] = infinity;
        break;
      case 4:
        box.min[axis] = S(-0.0);
        box.max[axis] = S(0.0);
        break;
      case 5:
        box.min[axis] = S(0.0);
        box.max[axis] = S(-0.0);
        break;
      case 6:
        box.min[axis] = box.max[axis] = random.index(2) == 0 ? infinity : -infinity;
        break;
      case 7:
        box.min[axis] = infinity;
        box.max[axis] = -infinity;
        break;
      case 8:
        box.min[axis] = std::numeric_limits<S>::denorm_min();
        box.max[axis] = S(1);
        break;
      default:
        break;
    }
  }
  return boxes;
}

Filters random_filters(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Filters filters(n);
  for (Filter& filter : filters) filter = {1u << random.index(3), static_cast<std::uint32_t>(random.index(8))};
  return filters;
}

template <class S>
class FewAgainstMany : public testing::Test {
 protected:
  Checker<S> check_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(FewAgainstMany, Scalars);

/// All sizes about those of a block and of what counts as few, either set first.
TYPED_TEST(FewAgainstMany, EqualsTruthForBoxesOfEveryKind) {
  for (const std::size_t few : {1, 2, 3, 16, 63, 64, 65, 127, 128, 191, 192, 193, 260, 320, 321})
    for (const std::size_t many : {1, 2, 15, 63, 64, 65, 130, 1000, 5000}) {
      const auto a = mixed_boxes<TypeParam>(few, few), b = mixed_boxes<TypeParam>(many, many + 1000);
      const std::string scene = std::to_string(few) + " against " + std::to_string(many);
      ASSERT_TRUE(this->check_.two_sets(a, b, scene));
      ASSERT_TRUE(this->check_.two_sets(b, a, scene + " turned about"));
    }
}

TYPED_TEST(FewAgainstMany, EqualsTruthForEveryFamily) {
  for (const auto& set : box_sets_to_repeat<TypeParam>())
    for (const std::size_t few : {1, 10, 100}) {
      const auto a = set.make(few, 1), b = set.make(std::min<std::size_t>(3000, set.largest), 2);
      ASSERT_TRUE(this->check_.two_sets(a, b, set.name, few));
      ASSERT_TRUE(this->check_.two_sets(b, a, set.name + " turned about", few));
    }
}

/// One that holds all, and as many pairs as boxes: blocks full of hits, and more than the buffer holds at a time.
TYPED_TEST(FewAgainstMany, AllWithAll) {
  const BasicAabb<TypeParam> world{{-1000, -1000, -1000}, {1000, 1000, 1000}};
  const auto many = box_set<TypeParam>("dense").make(5000, 1);
  for (const std::size_t few : {1, 64, 70}) {
    const Boxes<TypeParam> a(few, world);
    ASSERT_TRUE(this->check_.two_sets(a, many, "worlds", few));
    ASSERT_TRUE(this->check_.two_sets(many, a, "worlds turned about", few));
  }
}

TYPED_TEST(FewAgainstMany, NobodyValid) {
  constexpr TypeParam nan = std::numeric_limits<TypeParam>::quiet_NaN();
  const Boxes<TypeParam> inert(10, {{nan, 0, 0}, {1, 1, 1}});
  const auto many = mixed_boxes<TypeParam>(500, 3);
  EXPECT_TRUE(this->check_.two_sets(inert, many, "few invalid ones"));
  EXPECT_TRUE(this->check_.two_sets(many, inert, "few invalid ones turned about"));
  EXPECT_TRUE(this->check_.two_sets(many, {}, "none"));
  EXPECT_TRUE(this->check_.two_sets({}, many, "none turned about"));
}

/// Each valid box of the one with each valid box of the other, no more.
TYPED_TEST(FewAgainstMany, CountsItsComparisons) {
  const auto a = mixed_boxes<TypeParam>(50, 1), b = mixed_boxes<TypeParam>(2000, 2);
  Pairs pairs;
  const Stats stats = this->check_.detector().find_pairs(a, b, pairs);
  const std::size_t valid_a = 50 - count_invalid(a), valid_b = 2000 - count_invalid(b);
  EXPECT_EQ(stats.tests, valid_a * valid_b);
  EXPECT_EQ(stats.records, valid_a + valid_b);
  EXPECT_EQ(stats.cells, 1u);
  EXPECT_EQ(stats.nodes, 0u);
}

TYPED_TEST(FewAgainstMany, FiltersDecide) {
  const auto a = mixed_boxes<TypeParam>(30, 5), b = mixed_boxes<TypeParam>(2000, 6);
  const Filters fa = random_filters(30, 5), fb = random_filters(2000, 6);
  Pairs pairs;
  this->check_.detector().find_pairs(a, b, pairs, fa, fb);
  expect_same_pairs(pairs, brute_force(a, b, fa, fb), a, b, "filtered", 0);
  this->check_.detector().find_pairs(b, a, pairs, fb, {});
  expect_same_pairs(pairs, brute_force(b, a, fb, {}), b, a, "filtered turned about", 0);
}

TYPED_TEST(FewAgainstMany, SinkStops) {
  const auto a = mixed_boxes<TypeParam>(30, 7), b = mixed_boxes<TypeParam>(5000, 8);
  Pairs all;
  this->check_.detector().find_pairs(a, b, all);
  ASSERT_GT(all.size(), 500u);
  for (const std::size_t calls : {1, 2, 3}) {
    Pairs some;
    std::size_t called = 0;
    const Stats stats = this->check_.detector().stream_pairs(a, b, [&](Span<const Pair> pairs) {
      some.insert(some.end(), pairs.begin(), pairs.end());
      return ++called < calls;
    });
    EXPECT_EQ(called, calls);
    EXPECT_EQ(stats.pairs, some.size());
    ASSERT_LT(some.size(), all.size());
    EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin()));
  }
}

/// By block of the many, then by index of the few, then by index of the many; so for any number of threads.
TYPED_TEST(FewAgainstMany, OrderIsByBlock) {
  const auto a = mixed_boxes<TypeParam>(19, 9), b = mixed_boxes<TypeParam>(40000, 10);
  const auto before = [](Pair x, Pair y) {
    const auto key = [](Pair p) { return std::tuple(p.b / 64, p.a, p.b); };
    return key(x) < key(y);
  };
  for (const unsigned threads : {1u, 4u}) {
    ThreadExecutor executor(threads);
    Detector detector(DetectorOptions{&executor});
    Pairs pairs;
    detector.find_pairs(a, b, pairs);
    EXPECT_FALSE(pairs.empty());
    EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end(), before)) << threads << " threads";
  }
}

}  // namespace
}  // namespace boxstream::tests
