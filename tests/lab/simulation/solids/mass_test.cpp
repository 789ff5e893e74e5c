// SPDX-License-Identifier: MIT
// What solids weigh, against points thrown into them and against each other: formulas, integrals over triangles, sums.
#include "simulation/engine/mass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "formats/geometry/convex_hull.hpp"
#include "formats/geometry/solid.hpp"
#include "simulation/engine/bullet_shapes.hpp"

namespace boxstream::scenes {
namespace {

using geometry::dot, geometry::minus, geometry::plus;
using geometry::Frame, geometry::Solid, geometry::Tensor;

std::mt19937 random_bits(20);

double random_between(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_bits);
}

Quat random_turn() {
  std::normal_distribution<double> normal;
  Quat q{normal(random_bits), normal(random_bits), normal(random_bits), normal(random_bits)};
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& x : q) x /= length;
  return q;
}

void expect_same(const Solid& solid, const Solid& other, double error) {
  const double size = std::cbrt(other.volume);
  EXPECT_NEAR(solid.volume / other.volume, 1, error);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(solid.centroid[i], other.centroid[i], error * size);
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(solid.inertia[i][j], other.inertia[i][j], error * other.volume * size * size) << i << j;
  }
}

/// By a fine lattice of points in a box.
Solid counted(const Vec3& half, const std::function<bool(const Vec3&)>& is_inside) {
  constexpr int n = 120;
  Solid solid;
  Vec3 moment{};
  Tensor about_origin{};
  const double cell = 8 * half[0] * half[1] * half[2] / (double{n} * n * n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const Vec3 p{half[0] * ((2 * i + 1.0) / n - 1), half[1] * ((2 * j + 1.0) / n - 1),
                     half[2] * ((2 * k + 1.0) / n - 1)};
        if (!is_inside(p)) continue;
        solid.volume += cell;
        moment = plus(moment, times(p, cell));
        about_origin = geometry::sum(about_origin, geometry::of_point(cell, p));
      }
    }
  }
  solid.centroid = times(moment, 1 / solid.volume);
  solid.inertia = geometry::sum(about_origin, geometry::of_point(-solid.volume, solid.centroid));
  return solid;
}

TEST(Mass, FormulasAgreeWithPointsThatAreCounted) {
  const double r = 0.4, h = 1.1;
  const auto across = [](const Vec3& p) { return std::hypot(p[0], p[2]); };
  expect_same(geometry::box({0.2, 0.3, 0.5}), counted({0.2, 0.3, 0.5}, [](const Vec3&) { return true; }), 1e-3);
  expect_same(geometry::ball(r), counted({r, r, r}, [&](const Vec3& p) { return dot(p, p) <= r * r; }), 2e-3);
  expect_same(geometry::cylinder(r, h), counted({r, h / 2, r}, [&](const Vec3& p) { return across(p) <= r; }), 2e-3);
  expect_same(geometry::capsule(r, h),
              counted({r, h / 2 + r, r},
                      [&](const Vec3& p) {
                        const double beyond = std::max(0.0, std::abs(p[1]) - h / 2);
                        return std::hypot(across(p), beyond) <= r;
                      }),
              2e-3);
  expect_same(geometry::cone(r, h),
              counted({r, h / 2, r}, [&](const Vec3& p) { return across(p) <= r * (0.5 - p[1] / h); }), 2e-3);
}

TEST(Mass, AHullIsWhatItEncloses) {
  for (int round = 0; round < 100; ++round) {
    const double size = std::pow(10.0, random_between(-3, 2));
    const Vec3 half{size * random_between(0.1, 1), size * random_between(0.1, 1), size * random_between(0.1, 1)};
    const Frame place{{size * random_between(-3, 3), size * random_between(-3, 3), size * random_between(-3, 3)},
                      random_turn()};
    std::vector<Vec3> points;
    for (int corner = 0; corner < 8; ++corner)
      points.push_back(place.place(
          Vec3{corner & 1 ? half[0] : -half[0], corner & 2 ? half[1] : -half[1], corner & 4 ? half[2] : -half[2]}));
    const auto hull = geometry::convex_hull(points);
    ASSERT_TRUE(hull);
    expect_same(geometry::solid_of(*hull), geometry::placed(place, geometry::box(half)), 1e-9);
  }
}

// A regular tetrahedron of edge a: volume a^3 / (6 sqrt 2), moments of m a^2 / 20.
TEST(Mass, ATetrahedronHasItsMoments) {
  const double s = 0.35, a = s * 2 * std::numbers::sqrt2;
  const auto hull = geometry::convex_hull({{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}});
  ASSERT_TRUE(hull);
  const Solid solid = geometry::solid_of(*hull);
  EXPECT_NEAR(solid.volume, a * a * a / (6 * std::numbers::sqrt2), 1e-12);
  const double moment = solid.volume * a * a / 20;
  expect_same(solid, {solid.volume, {}, geometry::diagonal({moment, moment, moment})}, 1e-12);
}

TEST(Mass, ACompoundIsTheSumOfItsParts) {
  // A box cut into two by a plane across x, both turned and moved as parts are, is the box.
  for (int round = 0; round < 100; ++round) {
    const Vec3 half{random_between(0.1, 1), random_between(0.1, 1), random_between(0.1, 1)};
    const double cut = half[0] * random_between(-0.9, 0.9);
    const double low = (half[0] + cut) / 2, high = (half[0] - cut) / 2;
    const Frame place{{random_between(-2, 2), random_between(-2, 2), random_between(-2, 2)}, random_turn()};
    const Vec3 of_low = place.place(Vec3{low - half[0], 0, 0}), of_high = place.place(Vec3{half[0] - high, 0, 0});
    ShapeSet set({{"low", BoxShape{{low, half[1], half[2]}}},
                  {"high", BoxShape{{high, half[1], half[2]}}},
                  {"both", CompoundShape{{{0, of_low, place.turn}, {1, of_high, place.turn}}}}});
    expect_same(set.solid(2), geometry::placed(place, geometry::box(half)), 1e-12);
  }
}

TEST(Mass, AFrameMakesTheTensorDiagonal) {
  for (int round = 0; round < 200; ++round) {
    const Frame place{{random_between(-1, 1), random_between(-1, 1), random_between(-1, 1)}, random_turn()};
    const Solid solid = geometry::placed(
        place, geometry::box({random_between(0.1, 1), random_between(0.1, 1), random_between(0.1, 1)}));
    Body body;
    body.traits.density = 3;
    const Mass mass = mass_of(body, solid);
    EXPECT_NEAR(mass.mass, 3 * solid.volume, 1e-12);
    const Tensor back = geometry::turned(mass.frame.turn, geometry::diagonal(mass.moments));
    expect_same({solid.volume, mass.frame.origin, geometry::scaled(back, 1 / 3.0)}, solid, 2e-6);
    // Never more than it must: no axis leans by more than 55 degrees from its own.
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3 axis{};
      axis[i] = 1;
      EXPECT_GT(dot(geometry::turned(mass.frame.turn, axis), axis), 0.3);
    }
  }
}

TEST(Mass, WhatABodySaysGoesFirst) {
  const Solid cone = geometry::cone(0.5, 1);
  Body body;
  body.traits.mass = 4;
  Mass mass = mass_of(body, cone);
  EXPECT_NEAR(mass.frame.origin[1], -0.25, 1e-15);
  EXPECT_NEAR(mass.moments[0], 4 * (3.0 / 20 * 0.25 + 3.0 / 80), 1e-12);
  EXPECT_NEAR(mass.moments[1], 4 * 0.3 * 0.25, 1e-12);
  body.centre = Vec3{0.1, 0.2, 0.3};
  EXPECT_EQ(mass_of(body, cone).frame.origin, (Vec3{0.1, 0.2, 0.3}));
  body.inertia = Vec3{1, 2, 3};
  body.centre.reset();
  mass = mass_of(body, cone);
  EXPECT_EQ(mass.frame.origin, Vec3{});
  EXPECT_EQ(mass.moments, (Vec3{1, 2, 3}));
  body.products = {0.1, 0, 0};
  mass = mass_of(body, cone);
  EXPECT_NEAR(mass.moments[0] + mass.moments[1], 3, 1e-12);
  EXPECT_NEAR(mass.moments[0] * mass.moments[1], 2 - 0.01, 1e-12);
  body.traits.type = BodyType::kinematic;
  EXPECT_EQ(mass_of(body, cone).mass, 0);
}

}  // namespace
}  // namespace boxstream::scenes
