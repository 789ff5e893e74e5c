// SPDX-License-Identifier: MIT
// Batches that are large enough for a tree of several levels.
#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "checks.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Large : public testing::Test {
 protected:
  Checker<S> checker_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Large, Scalars);

TYPED_TEST(Large, TwentyThousandOfEachSet) {
  for (const auto& set : box_sets_to_repeat<TypeParam>()) {
    if (set.largest < 20000) continue;
    const auto boxes = set.make(20000, 20);
    ASSERT_TRUE(this->checker_.one_set(boxes, set.name, 20));
  }
}

TYPED_TEST(Large, TwoSets) {
  for (const char* name : {"sparse", "slices_y", "comb_and_plates_x", "ties", "dust_and_planes", "clusters"}) {
    const auto& set = box_set<TypeParam>(name);
    const auto many = set.make(std::min<std::size_t>(20000, set.largest), 21);
    const auto some = set.make(std::min<std::size_t>(9000, set.largest), 22);
    const auto few = set.make(100, 23);
    ASSERT_TRUE(this->checker_.two_sets(many, some, set.name, 21));
    ASSERT_TRUE(this->checker_.two_sets(few, many, set.name, 22));
    ASSERT_TRUE(this->checker_.two_sets(many, few, set.name, 23));
  }
}

TYPED_TEST(Large, SixtyThousand) {
  for (const char* name : {"sparse", "slices_x", "six_decades", "layer"}) {
    const auto boxes = box_set<TypeParam>(name).make(60000, 60);
    ASSERT_TRUE(this->checker_.one_set(boxes, name, 60));
  }
}

/// Teeth against plates as two sets, where every pair meets on two axes.
TYPED_TEST(Large, CombAgainstPlates) {
  for (const char* name : {"comb_and_plates_x", "comb_and_plates_y", "comb_and_plates_z"}) {
    Boxes<TypeParam> sides[2];
    const auto all = box_set<TypeParam>(name).make(20000, 7);
    for (std::size_t i = 0; i < all.size(); ++i) sides[i % 2].push_back(all[i]);
    ASSERT_TRUE(this->checker_.two_sets(sides[0], sides[1], name, 7));
  }
}

/// Everything meets everything: 1.3 million pairs, none twice.
TYPED_TEST(Large, QuadraticOutput) {
  constexpr std::size_t n = 1600;
  Pairs all;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = i + 1; j < n; ++j) all.push_back({i, j});
  for (const char* name : {"identical", "equal_low", "nested", "all_overlapping"}) {
    const auto boxes = box_set<TypeParam>(name).make(n, 8);
    ASSERT_TRUE(this->checker_.one_set(boxes, all, name, 8));
  }
}

/// A third of all boxes are infinite on one axis, a third on two: they span every node there is.
TYPED_TEST(Large, InfiniteRodsAndPlates) {
  Boxes<TypeParam> boxes = box_set<TypeParam>("sparse").make(4000, 9);
  constexpr TypeParam inf = std::numeric_limits<TypeParam>::infinity();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::size_t spans = i % 3;
    for (std::size_t k = 0; k < spans; ++k) {
      const std::size_t d = (i / 3 + k) % 3;
      boxes[i].min[d] = -inf;
      boxes[i].max[d] = inf;
    }
  }
  ASSERT_TRUE(this->checker_.one_set(boxes, "infinite rods and plates", 9));
}

/// Double boxes far from the origin, where the leading bits of all coordinates are the same, must not fall back to
/// comparing everything with everything.
TEST(LargeFarFromTheOrigin, WorkDoesNotGrow) {
  Checker<double> checker;
  const auto near = box_set<double>("sparse").make(20000, 1);
  Pairs pairs;
  const Stats near_stats = checker.detector().find_pairs(near, pairs);
  for (const double offset : {1e6, 1e7, 1e8, 1e12}) {
    SCOPED_TRACE(offset);
    auto far = near;
    for (auto& box : far)
      for (int d = 0; d < 3; ++d) {
        box.min[d] += offset;
        box.max[d] += offset;
      }
    EXPECT_TRUE(checker.one_set(far, "sparse, far from the origin"));
    EXPECT_LE(checker.detector().find_pairs(far, pairs).tests, 4 * near_stats.tests);
  }
}

}  // namespace
}  // namespace boxstream::tests
