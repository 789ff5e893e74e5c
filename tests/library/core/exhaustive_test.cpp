// SPDX-License-Identifier: MIT
// All configurations of a few boxes on a grid of three values: every way in which intervals can meet, and every tie.
#include <array>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "checks.hpp"
#include "random.hpp"

namespace boxstream::tests {
namespace {

struct Interval {
  int lo, hi;
};

/// The six closed intervals on {0, 1, 2}, and with `inverted` also the three that run backwards.
std::vector<Interval> intervals(bool inverted) {
  std::vector<Interval> all;
  for (int lo = 0; lo < 3; ++lo)
    for (int hi = inverted ? 0 : lo; hi < 3; ++hi) all.push_back({lo, hi});
  return all;
}

/// Boxes that differ on `axis` only; on the others they coincide.
template <class S>
Boxes<S> on_axis(const std::vector<Interval>& choice, int axis) {
  std::vector<BasicAabb<S>> boxes;
  for (const Interval interval : choice) {
    BasicAabb<S> box{{1, 1, 1}, {2, 2, 2}};
    box.min[axis] = static_cast<S>(interval.lo);
    box.max[axis] = static_cast<S>(interval.hi);
    boxes.push_back(box);
  }
  return boxes;
}

/// All boxes that span grid intervals on the first `dims` axes counted from `first_axis`; the rest coincide.
template <class S>
Boxes<S> grid_boxes(int dims, int first_axis) {
  const std::vector<Interval> all = intervals(false);
  Boxes<S> boxes{{{1, 1, 1}, {1, 1, 1}}};
  for (int k = 0; k < dims; ++k) {
    const int axis = (first_axis + k) % 3;
    Boxes<S> wider;
    for (BasicAabb<S> box : boxes)
      for (const Interval interval : all) {
        box.min[axis] = static_cast<S>(interval.lo);
        box.max[axis] = static_cast<S>(interval.hi);
        wider.push_back(box);
      }
    boxes = wider;
  }
  return boxes;
}

/// Calls `visit` with every sequence of `length` indices below `count`, until it returns false.
bool for_each_sequence(std::size_t length, std::size_t count,
                       const std::function<bool(const std::vector<std::size_t>&)>& visit) {
  std::vector<std::size_t> digits(length, 0);
  for (;;) {
    if (!visit(digits)) return false;
    std::size_t place = 0;
    while (place < length && ++digits[place] == count) digits[place++] = 0;
    if (place == length) return true;
  }
}

/// The same for sequences that do not decrease: every choice with repetition, once.
bool for_each_choice(std::size_t length, std::size_t count,
                     const std::function<bool(const std::vector<std::size_t>&)>& visit) {
  std::vector<std::size_t> digits(length, 0);
  for (;;) {
    if (!visit(digits)) return false;
    std::size_t place = length;
    while (place > 0 && digits[place - 1] == count - 1) --place;
    if (place == 0) return true;
    const std::size_t next = digits[place - 1] + 1;
    for (std::size_t i = place - 1; i < length; ++i) digits[i] = next;
  }
}

template <class T>
std::vector<T> pick(const std::vector<T>& from, const std::vector<std::size_t>& indices) {
  std::vector<T> picked;
  for (const std::size_t i : indices) picked.push_back(from[i]);
  return picked;
}

template <class S>
class Exhaustive : public testing::Test {
 protected:
  bool check(const Boxes<S>& boxes, const char* scene) {
    ++searches_;
    return checker_.one_set(boxes, brute_force(boxes), scene, searches_);
  }
  bool check(const Boxes<S>& a, const Boxes<S>& b, const char* scene) {
    ++searches_;
    return checker_.two_sets(a, b, brute_force(a, b), scene, searches_);
  }

  Checker<S> checker_;
  std::uint64_t searches_ = 0;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Exhaustive, Scalars);

TYPED_TEST(Exhaustive, OneAxisUpToFourBoxesWithInvertedOnes) {
  using S = TypeParam;
  const auto all = intervals(true);
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t n = 0; n <= 4; ++n)
      ASSERT_TRUE(for_each_sequence(n, all.size(), [&](const auto& digits) {
        return this->check(on_axis<S>(pick(all, digits), axis), "one axis, with inverted");
      }));
  EXPECT_EQ(this->searches_, 3u * (1 + 9 + 81 + 729 + 6561));
}

TYPED_TEST(Exhaustive, OneAxisFiveBoxes) {
  using S = TypeParam;
  const auto all = intervals(false);
  for (int axis = 0; axis < 3; ++axis)
    ASSERT_TRUE(for_each_sequence(5, all.size(), [&](const auto& digits) {
      return this->check(on_axis<S>(pick(all, digits), axis), "one axis");
    }));
  EXPECT_EQ(this->searches_, 3u * 7776);
}

TYPED_TEST(Exhaustive, OneAxisTwoSetsUpToFiveBoxes) {
  using S = TypeParam;
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t n = 0; n <= 5; ++n) {
      const auto all = intervals(n <= 3);
      for (std::size_t in_a = 0; in_a <= n; ++in_a)
        ASSERT_TRUE(for_each_sequence(n, all.size(), [&](const auto& digits) {
          const auto boxes = on_axis<S>(pick(all, digits), axis);
          const auto split = boxes.begin() + static_cast<std::ptrdiff_t>(in_a);
          return this->check(Boxes<S>(boxes.begin(), split), Boxes<S>(split, boxes.end()), "one axis, two sets");
        }));
    }
  EXPECT_EQ(this->searches_, 3u * (1 + 2 * 9 + 3 * 81 + 4 * 729 + 5 * 1296 + 6 * 7776));
}

TYPED_TEST(Exhaustive, TwoAxesUpToThreeBoxes) {
  using S = TypeParam;
  for (int axis = 0; axis < 3; ++axis) {
    const auto all = grid_boxes<S>(2, axis);
    for (std::size_t n = 2; n <= 3; ++n)
      ASSERT_TRUE(for_each_sequence(n, all.size(),
                                    [&](const auto& digits) { return this->check(pick(all, digits), "two axes"); }));
  }
  EXPECT_EQ(this->searches_, 3u * (1296 + 46656));
}

/// Every set of four boxes, but each in one random order only (all orders would be 5 million searches).
TYPED_TEST(Exhaustive, TwoAxesFourBoxesEachInOneOrder) {
  using S = TypeParam;
  Random random(4);
  for (int axis = 0; axis < 3; ++axis) {
    const auto all = grid_boxes<S>(2, axis);
    ASSERT_TRUE(for_each_choice(4, all.size(), [&](const auto& digits) {
      auto boxes = pick(all, digits);
      random.shuffle(boxes);
      return this->check(boxes, "two axes, one order");
    }));
  }
  EXPECT_EQ(this->searches_, 3u * 82251);
}

TYPED_TEST(Exhaustive, ThreeAxesTwoBoxes) {
  using S = TypeParam;
  const auto all = grid_boxes<S>(3, 0);
  ASSERT_EQ(all.size(), 216u);
  ASSERT_TRUE(for_each_sequence(2, all.size(), [&](const auto& digits) {
    const auto boxes = pick(all, digits);
    return this->check(boxes, "three axes") && this->check({boxes[0]}, {boxes[1]}, "three axes, two sets");
  }));
  EXPECT_EQ(this->searches_, 2u * 46656);
}

/// A sample of 60 000 out of 10^7 (three boxes) to 5 * 10^11 (five boxes).
TYPED_TEST(Exhaustive, ThreeAxesThreeToFiveBoxesSampled) {
  using S = TypeParam;
  Random random(5);
  const auto all = grid_boxes<S>(3, 0);
  for (int round = 0; round < 20000; ++round)
    for (std::size_t n = 3; n <= 5; ++n) {
      std::vector<std::size_t> digits(n);
      for (std::size_t& digit : digits) digit = random.index(all.size());
      const auto boxes = pick(all, digits);
      const auto split = boxes.begin() + static_cast<std::ptrdiff_t>(random.index(n + 1));
      ASSERT_TRUE(this->check(boxes, "three axes, sampled"));
      ASSERT_TRUE(
          this->check(Boxes<S>(boxes.begin(), split), Boxes<S>(split, boxes.end()), "three axes, two sets, sampled"));
    }
}

/// Many small configurations side by side in one batch, so that they meet the splits of a tree, not only the
/// comparison of a few boxes. Groups are kept apart on axis `apart` alone, hence share their bounds on the others.
template <class S>
struct Tiled {
  Boxes<S> boxes;
  Pairs pairs;

  void add(Boxes<S> group, int apart, int at) {
    const auto first = static_cast<std::uint32_t>(boxes.size());
    for (const Pair pair : brute_force(group)) pairs.push_back({first + pair.a, first + pair.b});
    for (auto& box : group) {
      box.min[apart] += static_cast<S>(at);
      box.max[apart] += static_cast<S>(at);
    }
    boxes.insert(boxes.end(), group.begin(), group.end());
  }

  void shuffle(Random& random) {
    std::vector<std::uint32_t> order(boxes.size()), place(boxes.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    random.shuffle(order);
    Boxes<S> moved;
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      place[order[i]] = i;
      moved.push_back(boxes[order[i]]);
    }
    boxes = moved;
    for (Pair& pair : pairs) {
      pair = {place[pair.a], place[pair.b]};
      if (pair.b < pair.a) std::swap(pair.a, pair.b);
    }
    std::sort(pairs.begin(), pairs.end());
  }
};

TYPED_TEST(Exhaustive, OneAxisFourBoxesTiledInOneBatch) {
  using S = TypeParam;
  Random random(6);
  const auto all = intervals(false);
  for (int axis = 0; axis < 3; ++axis)
    for (int apart = 0; apart < 3; ++apart) {
      Tiled<S> tiled;
      int at = 0;
      for_each_sequence(4, all.size(), [&](const auto& digits) {
        tiled.add(on_axis<S>(pick(all, digits), axis), apart, at++ * 3);
        return true;
      });
      ASSERT_EQ(tiled.boxes.size(), 4u * 1296);
      tiled.shuffle(random);
      ASSERT_TRUE(this->checker_.one_set(tiled.boxes, tiled.pairs, "one axis, tiled"));
    }
}

TYPED_TEST(Exhaustive, ThreeAxesTwoBoxesTiledInOneBatch) {
  using S = TypeParam;
  Random random(7);
  const auto all = grid_boxes<S>(3, 0);
  for (int apart = 0; apart < 3; ++apart) {
    Tiled<S> tiled;
    int at = 0;
    for_each_choice(2, all.size(), [&](const auto& digits) {
      tiled.add(pick(all, digits), apart, at++ * 3);
      return true;
    });
    ASSERT_EQ(tiled.boxes.size(), 2u * 23436);
    tiled.shuffle(random);
    ASSERT_TRUE(this->checker_.one_set(tiled.boxes, tiled.pairs, "three axes, tiled"));
  }
}

}  // namespace
}  // namespace boxstream::tests
