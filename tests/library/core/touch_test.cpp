// SPDX-License-Identifier: MIT
// Closed boxes: what touches is a pair, what is one step of the scalar apart is not. No epsilon in either direction.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "checks.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Touch : public testing::Test {
 protected:
  static S up(S x) { return std::nextafter(x, std::numeric_limits<S>::infinity()); }
  static S down(S x) { return std::nextafter(x, -std::numeric_limits<S>::infinity()); }

  /// `n` boxes that have nothing to do with the pair under test, to push it into the tree.
  static Boxes<S> bystanders(std::size_t n) {
    Boxes<S> boxes = box_set<S>("sparse").make(n, 1);
    for (auto& box : boxes)
      for (int d = 0; d < 3; ++d) {
        box.min[d] += 10;
        box.max[d] += 10;
      }
    return boxes;
  }

  /// The pair alone, and among others; as one set and as two.
  void expect_pair(const BasicAabb<S>& a, const BasicAabb<S>& b, bool pair) {
    SCOPED_TRACE("a " + describe(a) + "\nb " + describe(b));
    ASSERT_EQ(touch(a, b), pair) << "the oracle itself";
    for (const Boxes<S>& others : {Boxes<S>{}, bystanders(100), crowd_}) {
      Boxes<S> boxes = others;
      boxes.insert(boxes.begin() + static_cast<std::ptrdiff_t>(others.size() / 3), a);
      boxes.push_back(b);
      checker_.one_set(boxes, "touch");
      if (others.empty()) {
        EXPECT_EQ(checker_.found().size(), pair ? 1u : 0u);
      }
      checker_.two_sets({a}, {b}, "touch, two sets");
    }
  }

  Boxes<S> crowd_ = bystanders(700);
  Checker<S> checker_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Touch, Scalars);

/// All 26 neighbours of a cube: across 6 faces, 12 edges and 8 corners; then with a gap of one step on each axis that
/// they meet on, in the place of either box.
TYPED_TEST(Touch, FacesEdgesAndCorners) {
  using Box = BasicAabb<TypeParam>;
  const Box cube{{1, 1, 1}, {2, 2, 2}};
  for (int neighbour = 0; neighbour < 27; ++neighbour) {
    const int step[3] = {neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1};
    Box other = cube;
    for (int d = 0; d < 3; ++d) {
      other.min[d] += static_cast<TypeParam>(step[d]);
      other.max[d] += static_cast<TypeParam>(step[d]);
    }
    this->expect_pair(cube, other, true);
    for (int d = 0; d < 3; ++d) {
      if (step[d] == 0) continue;
      Box apart = other;
      if (step[d] > 0)
        apart.min[d] = this->up(apart.min[d]);
      else
        apart.max[d] = this->down(apart.max[d]);
      this->expect_pair(cube, apart, false);
      this->expect_pair(apart, cube, false);
      Box into = other;
      if (step[d] > 0)
        into.min[d] = this->down(into.min[d]);
      else
        into.max[d] = this->up(into.max[d]);
      this->expect_pair(into, cube, true);
    }
  }
}

/// At every magnitude, of either sign: contact at x, one step apart, one step into each other.
TYPED_TEST(Touch, AtEveryMagnitude) {
  using Box = BasicAabb<TypeParam>;
  using Limits = std::numeric_limits<TypeParam>;
  std::vector<TypeParam> places = {0, Limits::denorm_min(), Limits::min(), Limits::max() / 2, TypeParam(1e18)};
  for (int exponent = Limits::min_exponent; exponent < Limits::max_exponent - 1; exponent += Limits::max_exponent / 16)
    places.push_back(std::ldexp(TypeParam(1.1), exponent));
  for (const TypeParam place : places)
    for (const TypeParam x : {place, -place})
      for (int axis = 0; axis < 3; ++axis) {
        Box below{{1, 1, 1}, {2, 2, 2}}, above = below;
        below.min[axis] = Limits::lowest();
        below.max[axis] = x;
        above.min[axis] = x;
        above.max[axis] = Limits::max();
        this->expect_pair(below, above, true);
        above.min[axis] = this->up(x);
        this->expect_pair(below, above, false);
        above.min[axis] = this->down(x);
        this->expect_pair(below, above, true);
      }
}

TYPED_TEST(Touch, ZeroesOfEitherSignAreOnePlace) {
  using Box = BasicAabb<TypeParam>;
  const TypeParam zeros[2] = {TypeParam(0), -TypeParam(0)};
  for (const TypeParam end : zeros)
    for (const TypeParam begin : zeros)
      for (int axis = 0; axis < 3; ++axis) {
        Box below{{-1, -1, -1}, {1, 1, 1}}, above = below;
        below.max[axis] = end;
        above.min[axis] = begin;
        this->expect_pair(below, above, true);
        Box point = below;
        point.min[axis] = begin;
        point.max[axis] = end;
        this->expect_pair(point, above, true);
      }
}

TYPED_TEST(Touch, InfinityMeetsInfinity) {
  using Box = BasicAabb<TypeParam>;
  using Limits = std::numeric_limits<TypeParam>;
  constexpr TypeParam inf = Limits::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    Box end{{0, 0, 0}, {1, 1, 1}}, half = end, last = end;
    end.min[axis] = end.max[axis] = inf;
    half.min[axis] = 5;
    half.max[axis] = inf;
    last.min[axis] = last.max[axis] = Limits::max();
    this->expect_pair(end, end, true);
    this->expect_pair(end, half, true);
    this->expect_pair(last, half, true);
    this->expect_pair(last, end, false);
  }
}

/// Doubles that are the same, or touch, when cut to float or to their leading 32 bits, but do not touch.
TEST(TouchBelowFloat, OnlyFullPrecisionDecides) {
  Checker<double> checker;
  for (const double x : {1.0, -1.0, 1e-40, 1e40, 3.0e-310, 123456.789})
    for (const double gap : {0x1p-52, 0x1p-40, 0x1p-33, 0x1p-30, 0x1p-24, 0x1p-21})
      for (int axis = 0; axis < 3; ++axis) {
        const double distance = std::max(std::abs(x) * gap, std::numeric_limits<double>::denorm_min());
        Aabb64 below{{0, 0, 0}, {1, 1, 1}}, above = below, apart = below;
        below.min[axis] = -1e300;
        below.max[axis] = x;
        above.min[axis] = x;
        above.max[axis] = 1e300;
        apart = above;
        apart.min[axis] = x + distance;
        ASSERT_GT(apart.min[axis], x);
        const Boxes<double> boxes{apart, below, above};
        checker.one_set(boxes, {{0, 2}, {1, 2}}, "doubles apart by " + std::to_string(gap));
      }
}

}  // namespace
}  // namespace boxstream::tests
