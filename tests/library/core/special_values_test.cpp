// SPDX-License-Identifier: MIT
// Boxes that make no sense, or too much: they pair with what they should and disturb no other box.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "checks.hpp"
#include "random.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class SpecialValues : public testing::Test {
 protected:
  Checker<S> checker_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SpecialValues, Scalars);

/// Each of the six sides in turn, each kind of NaN, in batches of each kind of size.
TYPED_TEST(SpecialValues, NanOnAnySideMakesOneBoxInert) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const std::size_t n : {2, 20, 100, 3000}) {
    const auto clean = box_set<TypeParam>("dense").make(n, n);
    const Pairs pairs = this->checker_.one_set(clean, "dense", n) ? this->checker_.found() : Pairs{};
    ASSERT_FALSE(pairs.empty() && n > 20);
    for (int side = 0; side < 6; ++side)
      for (const TypeParam nan : {Limits::quiet_NaN(), -Limits::quiet_NaN(), Limits::signaling_NaN()}) {
        auto boxes = clean;
        const auto victim = static_cast<std::uint32_t>(n / 2);
        (side < 3 ? boxes[victim].min : boxes[victim].max)[side % 3] = nan;
        Pairs others;
        for (const Pair pair : pairs)
          if (pair.a != victim && pair.b != victim) others.push_back(pair);
        std::sort(others.begin(), others.end());
        ASSERT_TRUE(this->checker_.one_set(boxes, others, "one NaN", n));
      }
  }
}

TYPED_TEST(SpecialValues, NothingButInvalidBoxes) {
  using Limits = std::numeric_limits<TypeParam>;
  const BasicAabb<TypeParam> inverted{{1, 1, 1}, {0, 0, 0}};
  const BasicAabb<TypeParam> nan{{Limits::quiet_NaN(), 0, 0}, {1, 1, 1}};
  const BasicAabb<TypeParam> inside_out{{Limits::infinity(), Limits::infinity(), Limits::infinity()},
                                        {-Limits::infinity(), -Limits::infinity(), -Limits::infinity()}};
  for (const std::size_t n : {1, 2, 64, 65, 2000})
    for (const auto& box : {inverted, nan, inside_out}) {
      const Boxes<TypeParam> boxes(n, box);
      EXPECT_TRUE(this->checker_.one_set(boxes, Pairs{}, "nothing valid", n));
      EXPECT_TRUE(this->checker_.two_sets(boxes, boxes, Pairs{}, "nothing valid", n));
      const auto valid = box_set<TypeParam>("dense").make(500, n);
      EXPECT_TRUE(this->checker_.two_sets(boxes, valid, Pairs{}, "nothing valid on one side", n));
      EXPECT_TRUE(this->checker_.two_sets(valid, boxes, Pairs{}, "nothing valid on one side", n));
    }
}

/// Nearly all invalid: whatever a sample of the boxes sees, the few valid ones must be found.
TYPED_TEST(SpecialValues, FewValidAmongManyInvalid) {
  using Limits = std::numeric_limits<TypeParam>;
  auto boxes = box_set<TypeParam>("all_overlapping").make(5000, 1);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (i % 97 != 13) boxes[i].max[i % 3] = Limits::quiet_NaN();
  EXPECT_TRUE(this->checker_.one_set(boxes, "few valid"));
  EXPECT_EQ(this->checker_.found().size(), 51u * 52 / 2);
}

/// The inverse: a box that claims all of space by being inverted at infinity must not swallow the batch.
TYPED_TEST(SpecialValues, AllOfSpaceMeetsEverybody) {
  using Limits = std::numeric_limits<TypeParam>;
  constexpr TypeParam inf = Limits::infinity();
  for (const std::size_t n : {3, 70, 3000}) {
    auto boxes = box_set<TypeParam>("sparse").make(n, n);
    const std::size_t before = brute_force(boxes).size();
    boxes.push_back({{-inf, -inf, -inf}, {inf, inf, inf}});
    boxes.push_back({{inf, inf, inf}, {-inf, -inf, -inf}});
    ASSERT_TRUE(this->checker_.one_set(boxes, "all of space", n));
    EXPECT_EQ(this->checker_.found().size(), before + n);
  }
}

/// All at infinity, or all with one end there, so that no finite number tells them apart.
TYPED_TEST(SpecialValues, EverybodyAtInfinity) {
  using Limits = std::numeric_limits<TypeParam>;
  constexpr TypeParam inf = Limits::infinity();
  for (const std::size_t n : {5, 64, 65, 300, 1200})
    for (int axes = 1; axes <= 7; ++axes)
      for (int ends = 0; ends < 3; ++ends) {
        auto boxes = box_set<TypeParam>("sparse").make(n, n);
        for (auto& box : boxes)
          for (int d = 0; d < 3; ++d)
            if ((axes >> d & 1) != 0) {
              if (ends != 1) box.min[d] = ends == 0 ? -inf : inf;
              if (ends != 0) box.max[d] = inf;
            }
        ASSERT_TRUE(this->checker_.one_set(boxes, "at infinity", n));
      }
}

/// Two places as far apart as the scalar can say, and nothing between.
TYPED_TEST(SpecialValues, BothEndsOfTheRange) {
  using Limits = std::numeric_limits<TypeParam>;
  Random random(3);
  for (const std::size_t n : {10, 100, 1000}) {
    Boxes<TypeParam> boxes;
    for (std::size_t i = 0; i < n; ++i) {
      BasicAabb<TypeParam> box{};
      for (int d = 0; d < 3; ++d) {
        const bool low = random.chance(0.5);
        box.min[d] = low || random.chance(0.1) ? Limits::lowest() : Limits::max();
        box.max[d] = low ? Limits::lowest() : Limits::max();
      }
      boxes.push_back(box);
    }
    ASSERT_TRUE(this->checker_.one_set(boxes, "both ends of the range", n));
    const auto half = static_cast<std::ptrdiff_t>(n / 2);
    ASSERT_TRUE(this->checker_.two_sets(Boxes<TypeParam>(boxes.begin(), boxes.begin() + half),
                                        Boxes<TypeParam>(boxes.begin() + half, boxes.end()), "both ends", n));
  }
}

/// All within the last few powers of two before infinity, or before minus infinity.
TYPED_TEST(SpecialValues, NextToInfinity) {
  using Limits = std::numeric_limits<TypeParam>;
  constexpr int top = Limits::max_exponent;
  const TypeParam places[] = {std::ldexp(TypeParam(1), top - 3),
                              std::ldexp(TypeParam(1.5), top - 3),
                              std::ldexp(TypeParam(1), top - 2),
                              std::ldexp(TypeParam(1), top - 1),
                              Limits::max(),
                              Limits::infinity()};
  Random random(4);
  for (const TypeParam sign : {TypeParam(1), TypeParam(-1)})
    for (const std::size_t n : {10, 100, 1000})
      for (int highest = 0; highest < 6; ++highest) {
        Boxes<TypeParam> boxes;
        for (std::size_t i = 0; i < n; ++i) {
          BasicAabb<TypeParam> box{};
          for (int d = 0; d < 3; ++d) {
            const TypeParam x = sign * places[random.integer(0, highest)],
                            y = sign * places[random.integer(0, highest)];
            box.min[d] = std::min(x, y);
            box.max[d] = random.chance(0.5) ? box.min[d] : std::max(x, y);
          }
          boxes.push_back(box);
        }
        ASSERT_TRUE(this->checker_.one_set(boxes, "next to infinity", n));
      }
}

}  // namespace
}  // namespace boxstream::tests
