// SPDX-License-Identifier: MIT
#include "simulation/engine/hull_width.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "formats/geometry/frame.hpp"

namespace boxstream::scenes {
namespace {

using geometry::dot, geometry::minus, geometry::plus, geometry::turned;

std::mt19937 random_bits(7);

double random_between(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_bits);
}

Vec3 random_direction() {
  std::normal_distribution<double> normal;
  const Vec3 v{normal(random_bits), normal(random_bits), normal(random_bits)};
  return times(v, 1 / std::sqrt(dot(v, v)));
}

double extent(const std::vector<Vec3>& points, const Vec3& way) {
  const auto less = [&](const Vec3& a, const Vec3& b) { return dot(a, way) < dot(b, way); };
  const auto [low, high] = std::minmax_element(points.begin(), points.end(), less);
  return dot(*high, way) - dot(*low, way);
}

/// The least extent that a search finds, from many directions downhill: never less than the width.
double searched_width(const std::vector<Vec3>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (int start = 0; start < 60; ++start) {
    Vec3 way = random_direction();
    double here = extent(points, way);
    for (double reach = 1; reach > 1e-5; reach *= 0.97) {
      Vec3 next = plus(way, times(random_direction(), reach));
      next = times(next, 1 / std::sqrt(dot(next, next)));
      if (const double there = extent(points, next); there < here) here = there, way = next;
    }
    least = std::min(least, here);
  }
  return least;
}

double diagonal(const std::vector<Vec3>& points) {
  return std::sqrt(std::pow(extent(points, {1, 0, 0}), 2) + std::pow(extent(points, {0, 1, 0}), 2) +
                   std::pow(extent(points, {0, 0, 1}), 2));
}

std::vector<Vec3> box_turned(const Vec3& half_extents, const Quat& rotation, const Vec3& at) {
  std::vector<Vec3> points;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 p = half_extents;
    for (std::size_t d = 0; d < 3; ++d) p[d] *= (corner >> d) % 2 == 0 ? -1 : 1;
    points.push_back(plus(turned(rotation, p), at));
  }
  return points;
}

TEST(HullWidth, OfAPlateIsItsThicknessHoweverItIsTurnedAndWherever) {
  for (int i = 0; i < 50; ++i) {
    const Vec3 axis = random_direction();
    const double half_turn = random_between(0, 3);
    const double s = std::sin(half_turn);
    const Quat rotation{s * axis[0], s * axis[1], s * axis[2], std::cos(half_turn)};
    const double found = hull_width(box_turned({1.5, 0.01, 1.5}, rotation, {1000, -200, 3}));
    EXPECT_LE(found, 0.02);
    EXPECT_GE(found, 0.0185);
  }
}

TEST(HullWidth, OfTwoCrossedEdgesIsTheirDistance) {
  const double found = hull_width({{-1, 0, 0}, {1, 0, 0}, {0, 0.1, -1}, {0, 0.1, 1}});
  EXPECT_LE(found, 0.1);
  EXPECT_GE(found, 0.099);
}

TEST(HullWidth, IsNeverMoreThanAnyDirectionShowsAndHardlyLess) {
  for (int i = 0; i < 40; ++i) {
    const Vec3 axis = random_direction();
    const double flat = random_between(0.02, 1);
    std::vector<Vec3> points;
    for (int k = 4 + i; k > 0; --k) {
      const Vec3 p = times(random_direction(), random_between(0.5, 1));
      points.push_back(minus(p, times(axis, (1 - flat) * dot(p, axis))));
    }
    const double found = hull_width(points), searched = searched_width(points);
    EXPECT_LE(found, searched) << i;
    EXPECT_GE(found, 0.99 * searched - 2e-4 * diagonal(points)) << i;
  }
}

TEST(HullWidth, OfManyCornersIsAlittleLessAtMost) {
  std::vector<Vec3> ball;
  for (int i = 0; i < 5000; ++i) ball.push_back(times(random_direction(), 2));
  EXPECT_LE(hull_width(ball), 4);
  EXPECT_GE(hull_width(ball), 3.8);
}

TEST(HullWidth, OfFlatPointsIsNone) {
  EXPECT_EQ(hull_width({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), 0);
  EXPECT_EQ(hull_width({{0, 0, 0}, {1, 0, 0}}), 0);
  EXPECT_EQ(hull_width({{1, 2, 3}}), 0);
}

}  // namespace
}  // namespace boxstream::scenes
