// SPDX-License-Identifier: MIT
// The predicates against rational numbers, above all where rounding alone would decide wrongly.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "formats/geometry/frame.hpp"
#include "mesh/point_triangle.hpp"
#include "random.hpp"
#include "rational.hpp"

namespace boxstream::mesh::tests {
namespace {

using boxstream::tests::Random;

std::string text(const Triangle& t) {
  std::string all;
  for (const Vec3& v : t)
    for (const double x : v) all += (all.empty() ? "" : " ") + std::to_string(x);
  return all;
}

int truth(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return sign(dot(cross(exactly(b) - exactly(a), exactly(c) - exactly(a)), exactly(d) - exactly(a)));
}

int truth(const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto minus = [](double x, double y) { return Rational(Rational(x) - Rational(y)); };
  return sign(minus(b[0], a[0]) * minus(c[1], a[1]) - minus(b[1], a[1]) * minus(c[0], a[0]));
}

Vec3 anywhere(Random& random) {
  const auto x = [&] { return 2 * random.unit() - 1; };
  return {x(), x(), x()};
}

/// A weighted mean of points, which rounding puts next to what they span.
Vec3 mean(const std::vector<Vec3>& points, Random& random) {
  Vec3 result{};
  double left = 1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double weight = i + 1 < points.size() ? 3 * random.unit() - 1 : left;
    left -= weight;
    for (std::size_t d = 0; d < 3; ++d) result[d] += weight * points[i][d];
  }
  return result;
}

/// On small whole numbers, where nearly everything touches and lies in common planes.
Vec3 on_grid(Random& random, int side) {
  const auto x = [&] { return static_cast<double>(random.integer(0, side)); };
  return {x(), x(), x()};
}

TEST(Orientation, OfPointsNextToAPlane) {
  Random random(1);
  int zero = 0, wrong_when_rounded = 0;
  for (int i = 0; i < 2000; ++i) {
    const double scale = std::ldexp(1.0, random.integer(-200, 200));
    Vec3 p[4] = {anywhere(random), anywhere(random), anywhere(random), {}};
    p[3] = mean({p[0], p[1], p[2]}, random);
    if (i % 3 == 0) {  // exactly in one plane
      for (Vec3& v : p)
        for (double& x : v) x = std::round(64 * x);
      p[3] = geometry::minus(geometry::plus(p[1], p[2]), p[0]);
    }
    for (Vec3& v : p)
      for (double& x : v) x *= scale;
    const int expected = truth(p[0], p[1], p[2], p[3]);
    ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), expected) << i;
    ASSERT_EQ(orientation(p[1], p[0], p[2], p[3]), -expected) << i;
    ASSERT_EQ(orientation(p[3], p[2], p[1], p[0]), expected) << i;
    zero += expected == 0;
    const auto minus = geometry::minus;
    const double rounded = geometry::dot(geometry::cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(p[3], p[0]));
    wrong_when_rounded += (rounded > 0) - (rounded < 0) != expected;
  }
  EXPECT_GT(zero, 300);
  EXPECT_GT(wrong_when_rounded, 100);  // the test is hard enough to need what it tests
}

TEST(Orientation, OfPointsNextToALine) {
  Random random(2);
  int wrong_when_rounded = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = anywhere(random), b = anywhere(random), c = mean({a, b}, random);
    const Vec2 p{a[0], a[1]}, q{b[0], b[1]}, r{c[0], c[1]};
    const int expected = truth(p, q, r);
    ASSERT_EQ(orientation(p, q, r), expected) << i;
    ASSERT_EQ(orientation(q, p, r), -expected) << i;
    const double rounded = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    wrong_when_rounded += (rounded > 0) - (rounded < 0) != expected;
  }
  EXPECT_GT(wrong_when_rounded, 20);
}

/// Every magnitude that is promised, mixed.
TEST(Orientation, OfCoordinatesOfAllMagnitudes) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    Vec3 p[4];
    for (Vec3& v : p)
      for (double& x : v) {
        x = random.integer(0, 9) == 0 ? 0 : std::pow(10.0, 140 * random.unit() - 70);
        if (random.integer(0, 1) == 1) x = -x;
      }
    if (i % 2 == 0) p[3] = p[random.index(3)];
    ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), truth(p[0], p[1], p[2], p[3])) << i;
    const Vec2 a{p[0][0], p[0][1]}, b{p[1][0], p[1][1]}, c{p[2][0], p[2][1]};
    ASSERT_EQ(orientation(a, b, c), truth(a, b, c)) << i;
  }
}

struct Tally {
  int meet = 0, apart = 0;

  void compare(int shared, const Triangle& s, const Triangle& t) {
    if (!tests::has_area(s) || !tests::has_area(t)) {
      ASSERT_FALSE(mesh::has_area(s) && mesh::has_area(t));
      return;
    }
    ASSERT_TRUE(mesh::has_area(s) && mesh::has_area(t)) << text(s) << " and " << text(t);
    const bool expected = meet_beyond(shared, s, t);
    (expected ? meet : apart) += 1;
    const auto ours = shared == 0 ? mesh::meet : shared == 1 ? meet_beyond_corner : meet_beyond_edge;
    ASSERT_EQ(ours(s, t), expected) << shared << " corners shared: " << text(s) << " and " << text(t);
    ASSERT_EQ(ours(t, s), expected) << shared << " corners shared: " << text(t) << " and " << text(s);
    if (shared > 0) return;
    // Corners in any order.
    ASSERT_EQ(ours({s[1], s[0], s[2]}, {t[2], t[0], t[1]}), expected) << text(s) << " and " << text(t);
  }
};

TEST(Triangles, OnSmallGrids) {
  for (const int side : {1, 2, 3, 9})
    for (int shared = 0; shared <= 2; ++shared) {
      SCOPED_TRACE("side " + std::to_string(side) + ", shared " + std::to_string(shared));
      Random random(static_cast<std::uint64_t>(10 * side + shared));
      Tally tally;
      for (int i = 0; i < 250 && !testing::Test::HasFatalFailure(); ++i) {
        Triangle s, t;
        for (Vec3& v : s) v = on_grid(random, side);
        for (Vec3& v : t) v = on_grid(random, side);
        if (i % 2 == 0)  // in one plane
          for (std::size_t c = 0; c < 3; ++c) s[c][2] = t[c][2] = 0;
        for (std::size_t c = 0; c < static_cast<std::size_t>(shared); ++c) t[c] = s[c];
        tally.compare(shared, s, t);
      }
      EXPECT_GT(tally.meet, 5);
      EXPECT_GT(tally.apart, 5);
    }
}

/// In planes that no float describes: corners of one are next to a plane, line or corner of the other.
TEST(Triangles, ThatNearlyTouch) {
  for (int shared = 0; shared <= 2; ++shared) {
    SCOPED_TRACE(shared);
    Random random(static_cast<std::uint64_t>(20 + shared));
    Tally tally;
    for (int i = 0; i < 300 && !testing::Test::HasFatalFailure(); ++i) {
      Triangle s, t;
      for (Vec3& v : s) v = anywhere(random);
      for (Vec3& v : t) {
        const int kind = random.integer(0, 3);
        v = kind == 0 ? anywhere(random) : kind == 1 ? mean({s[0], s[1]}, random) : mean({s[0], s[1], s[2]}, random);
      }
      for (std::size_t c = 0; c < static_cast<std::size_t>(shared); ++c) t[c] = s[c];
      if (i % 4 == 0)  // in the plane of x and y = z, so that some are in one plane
        for (std::size_t c = 0; c < 3; ++c) s[c][2] = s[c][1], t[c][2] = t[c][1];
      tally.compare(shared, s, t);
    }
    EXPECT_GT(tally.meet, 5);
    EXPECT_GT(tally.apart, 50);
  }
}

/// Moves of one unit in the last place decide whether triangles touch.
TEST(Triangles, OneStepApart) {
  const Triangle s{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const double above = std::numeric_limits<double>::denorm_min() * 0x1p900;
  const Triangle touches{{{0.25, 0.25, 0}, {0.25, 0.25, 1}, {0.5, 0.25, 1}}};
  Triangle apart = touches;
  apart[0][2] = above;
  EXPECT_TRUE(meet(s, touches));
  EXPECT_FALSE(meet(s, apart));
  const double beyond = std::nextafter(1.0, 2.0);
  EXPECT_TRUE(meet(s, {{{1, 0, 0}, {2, 1, 0}, {2, -1, 0}}}));
  EXPECT_FALSE(meet(s, {{{beyond, 0, 0}, {2, 1, 0}, {2, -1, 0}}}));
  EXPECT_TRUE(meet(s, {{{0.5, 0.5, 0}, {1, 1, 0}, {1, 1, 1}}}));
  EXPECT_FALSE(meet(s, {{{0.5, std::nextafter(0.5, 1.0), 0}, {1, 1, 0}, {1, 1, 1}}}));
}

Triangle thin(Random& random) {
  Triangle t{anywhere(random), anywhere(random), {}};
  t[2] = mean({t[0], t[1]}, random);
  const double step = std::pow(10.0, -17 * random.unit());
  for (double& x : t[2]) x += step * (random.unit() - 0.5);
  return t;
}

TEST(TriangleDistance, IsExactWithinRounding) {
  Random random(7);
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    Triangle t{anywhere(random), anywhere(random), anywhere(random)};
    if (i % 2 == 0) t = thin(random);
    if (i % 20 == 0) t[2] = t[1];
    if (i % 200 == 0) t[0] = t[1];
    Vec3 p = anywhere(random);
    if (i % 3 == 0) p = mean({t[0], t[1], t[2]}, random);
    if (i % 9 == 0) p[random.index(3)] += std::pow(10.0, -20 * random.unit());
    if (i % 27 == 1)
      for (double& x : p) x *= 1000;
    double longest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 e = geometry::minus(t[c], t[(c + 1) % 3]);
      longest = std::max(longest, std::sqrt(geometry::dot(e, e)));
    }
    const double expected = std::sqrt(static_cast<double>(squared_distance(p, t)));
    const TriangleDistance triangle(t);
    const double found = std::sqrt(triangle.squared(p, std::numeric_limits<double>::infinity()));
    const double unit = 0x1p-53 * (expected + longest);
    if (found != expected) worst = std::max(worst, std::abs(found - expected) / unit);
    ASSERT_LE(std::abs(found - expected), 16 * unit) << i << ": " << found << " for " << expected;
    // What is far need not be known, only that it is.
    const double enough = 4 * random.unit();
    const double cut = triangle.squared(p, enough);
    ASSERT_TRUE(cut == found * found || std::abs(cut - found * found) <= 1e-12 * cut || cut >= enough) << i;
  }
  RecordProperty("worst_in_units", std::to_string(worst));
  EXPECT_GT(worst, 0.1);
}

}  // namespace
}  // namespace boxstream::mesh::tests
