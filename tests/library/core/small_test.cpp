// SPDX-License-Identifier: MIT
// Searches of so few boxes that all are compared with all, and of a few more.
#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "random.hpp"
#include "same_pairs.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Small : public testing::Test {
 protected:
  using Box = BasicAabb<S>;

  /// Bounds on a coarse lattice, so that many faces coincide, with zeros of both signs, the ends of the range, boxes
  /// inside out, and a share of NaN.
  static Boxes<S> awkward(std::size_t n, std::uint64_t seed) {
    Random random(seed);
    const auto bound = [&](std::size_t axis_span) -> S {
      switch (random.index(40)) {
        case 0:
          return std::numeric_limits<S>::infinity();
        case 1:
          return -std::numeric_limits<S>::infinity();
        case 2:
          return -std::numeric_limits<S>::denorm_min();
        case 3:
          return S(-0.0);
        default:
          return static_cast<S>(static_cast<int>(random.index(axis_span)) - 3);
      }
    };
    Boxes<S> boxes(n);
    for (Box& box : boxes)
      for (int d = 0; d < 3; ++d) {
        box.min[d] = bound(8);
        box.max[d] = bound(8);
        if (box.min[d] > box.max[d] && random.index(20) != 0) std::swap(box.min[d], box.max[d]);
        if (random.index(60) == 0) (random.index(2) == 0 ? box.min : box.max)[d] = std::numeric_limits<S>::quiet_NaN();
      }
    return boxes;
  }

  Detector detector_;
  Pairs found_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Small, Scalars);

TYPED_TEST(Small, AwkwardBoxesOfEverySize) {
  for (std::size_t n = 0; n <= 400; n += n < 140 || n >= 380 ? 1 : 7)
    for (std::uint64_t seed = 1; seed <= (n < 70 ? 20u : 3u); ++seed) {
      const auto boxes = this->awkward(n, seed * 1000 + n);
      const Stats stats = this->detector_.find_pairs(boxes, this->found_);
      ASSERT_TRUE(expect_same_pairs(this->found_, brute_force(boxes), boxes, "awkward", n));
      ASSERT_EQ(stats.boxes, n);
      ASSERT_EQ(stats.pairs, this->found_.size());
      ASSERT_EQ(stats.invalid, count_invalid(boxes)) << n << " boxes, seed " << seed;
      ASSERT_LE(stats.records, n - stats.invalid);
    }
}

/// Boxes that share a byte on each axis with all of their crowd, and a few with others: bytes do not part them.
TYPED_TEST(Small, CrowdsThatAreSmallBesideTheWhole) {
  for (const std::size_t n : {65, 95, 96, 160, 200, 384, 385}) {
    Random random(n);
    Boxes<TypeParam> boxes(n);
    for (std::size_t i = 0; i < n; ++i)
      for (int d = 0; d < 3; ++d) {
        const auto at = static_cast<double>(i * 5 % 7 * 1000) + 0.001 * static_cast<double>(random.index(1000));
        boxes[i].min[d] = static_cast<TypeParam>(at);
        boxes[i].max[d] = static_cast<TypeParam>(at + 0.0001 * static_cast<double>(random.index(1000)));
      }
    const Stats stats = this->detector_.find_pairs(boxes, this->found_);
    ASSERT_TRUE(expect_same_pairs(this->found_, brute_force(boxes), boxes, "crowds", n));
    EXPECT_EQ(find_pairs(Span<const BasicAabb<TypeParam>>(boxes)), this->found_);
    EXPECT_EQ(stats.tests == n * (n - 1) / 2, n <= 384) << n;
    EXPECT_EQ(stats.records, n);
    const std::uint64_t ends[] = {0, n, n};
    PairsOfSets of_sets;
    this->detector_.find_pairs(boxes, ends, of_sets);
    EXPECT_EQ(of_sets.pairs, this->found_);
  }
}

/// One invalid box at each place, also in the last block, part of which is read twice.
TYPED_TEST(Small, OneInvalidBoxAnywhere) {
  for (std::size_t n = 1; n <= 66; ++n) {
    const Boxes<TypeParam> all(n, {{0, 0, 0}, {1, 1, 1}});
    for (std::size_t i = 0; i < n; ++i) {
      auto boxes = all;
      (i % 2 == 0 ? boxes[i].min : boxes[i].max)[i % 3] =
          i % 5 == 0 ? std::numeric_limits<TypeParam>::quiet_NaN() : TypeParam(i % 2 == 0 ? 2 : -2);
      const Stats stats = this->detector_.find_pairs(boxes, this->found_);
      ASSERT_EQ(stats.invalid, 1u) << i << " of " << n;
      ASSERT_EQ(stats.pairs, (n - 1) * (n - 2) / 2) << i << " of " << n;
      ASSERT_TRUE(std::none_of(this->found_.begin(), this->found_.end(), [&](Pair p) { return p.a == i || p.b == i; }));
    }
  }
}

/// NaN of the largest bits, whose order key is the largest there is.
TYPED_TEST(Small, LargestNaNsMeetNothing) {
  using Bits = std::conditional_t<sizeof(TypeParam) == 4, std::int32_t, std::int64_t>;
  const Bits largest = std::numeric_limits<Bits>::max();
  for (const std::size_t n : {3, 8, 20}) {
    Boxes<TypeParam> boxes(n, {{0, 0, 0}, {1, 1, 1}});
    for (auto& box : boxes) std::memcpy(&box.max[0], &largest, sizeof largest);
    EXPECT_EQ(this->detector_.find_pairs(boxes, this->found_).invalid, n);
    EXPECT_TRUE(this->found_.empty());
    EXPECT_EQ(this->detector_.find_pairs(boxes, boxes, this->found_).invalid, 2 * n);
    EXPECT_TRUE(this->found_.empty());
  }
}

/// Each pair once, the smaller index first.
TYPED_TEST(Small, AllTouch) {
  for (std::size_t n = 0; n <= 70; ++n) {
    const Boxes<TypeParam> boxes(n, {{0, 0, 0}, {1, 1, 1}});
    this->detector_.find_pairs(boxes, this->found_);
    ASSERT_TRUE(expect_same_pairs(this->found_, brute_force(boxes), boxes, "all touch", n));
    EXPECT_EQ(find_pairs(Span<const BasicAabb<TypeParam>>(boxes)), this->found_);
  }
}

TYPED_TEST(Small, Filters) {
  Random random(1);
  for (std::size_t n = 0; n <= 70; ++n) {
    const auto boxes = this->awkward(n, n);
    Filters filters(n);
    for (Filter& filter : filters)
      filter = {static_cast<std::uint32_t>(random.index(4)), static_cast<std::uint32_t>(random.index(4))};
    const Stats stats = this->detector_.find_pairs(boxes, this->found_, filters);
    ASSERT_TRUE(expect_same_pairs(this->found_, brute_force(boxes, filters), boxes, "filters", n));
    EXPECT_EQ(stats.pairs, this->found_.size());
  }
}

TYPED_TEST(Small, SinksStopAtOnce) {
  for (const std::size_t n : {2, 20, 64}) {
    const Boxes<TypeParam> boxes(n, {{0, 0, 0}, {1, 1, 1}});
    this->detector_.find_pairs(boxes, this->found_);
    Pairs streamed;
    int calls = 0;
    const Stats stats = this->detector_.stream_pairs(boxes, [&](Span<const Pair> pairs) {
      ++calls;
      streamed.insert(streamed.end(), pairs.begin(), pairs.end());
      return false;
    });
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(stats.pairs, streamed.size());
    ASSERT_TRUE(std::equal(streamed.begin(), streamed.end(), this->found_.begin()));
  }
}

/// Doubles that are the same as floats, far from the origin, are distinguished.
TEST(SmallDoubles, AreComparedByAllTheirBits) {
  Detector detector;
  Pairs found;
  for (std::size_t n = 2; n <= 70; ++n) {
    Boxes<double> boxes(n);
    for (std::size_t i = 0; i < n; ++i)
      for (int d = 0; d < 3; ++d) {
        boxes[i].min[d] = 1e15 + static_cast<double>(i);
        boxes[i].max[d] = 1e15 + static_cast<double>(i) + (i % 3 == 0 ? 1 : 0.75);
      }
    detector.find_pairs(boxes, found);
    ASSERT_TRUE(expect_same_pairs(found, brute_force(boxes), boxes, "far away", n));
  }
}

}  // namespace
}  // namespace boxstream::tests
