// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "formats/geometry/frame.hpp"
#include "mesh/generators.hpp"
#include "mesh/nearest_triangles.hpp"
#include "mesh/self_intersection.hpp"
#include "mesh/three_phases.hpp"
#include "random.hpp"

namespace boxstream::mesh::tests {
namespace {

using boxstream::tests::Random;

/// Every edge is on two triangles. Returns vertices - edges + triangles.
int characteristic_if_closed(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++edges[std::minmax(t[i], t[(i + 1) % 3])];
  for (const auto& [edge, times] : edges) EXPECT_EQ(times, 2) << edge.first << " " << edge.second;
  return static_cast<int>(mesh.vertices.size()) - static_cast<int>(edges.size()) +
         static_cast<int>(mesh.triangles.size());
}

TEST(Surfaces, AreClosed) {
  EXPECT_EQ(characteristic_if_closed(sphere(7, 12)), 2);
  EXPECT_EQ(characteristic_if_closed(torus(12, 7)), 0);
  EXPECT_EQ(characteristic_if_closed(klein_bottle(20, 8)), 0);
  EXPECT_EQ(klein_bottle(20, 8).triangles.size(), 320u);
  EXPECT_THROW(klein_bottle(20, 7), std::invalid_argument);
  EXPECT_THROW(klein_bottle(4, 8), std::invalid_argument);
  EXPECT_THROW(sphere(1, 8), std::invalid_argument);
  EXPECT_THROW(torus(3, 2), std::invalid_argument);
}

TEST(SelfIntersections, SphereAndTorusHaveNone) {
  for (const TriangleMesh& mesh : {sphere(40, 80), torus(80, 40), torus(30, 90, 0.95)}) {
    const SelfIntersections found = self_intersections(mesh);
    EXPECT_TRUE(found.pairs.empty());
    EXPECT_TRUE(found.without_area.empty());
    // At least the six or so neighbours at corners, and the three at edges, half of them each.
    EXPECT_GT(found.candidates, 5 * mesh.triangles.size());
  }
}

TEST(SelfIntersections, AreThoseOfAllPairs) {
  TriangleMesh mesh = klein_bottle(30, 16);
  const TriangleMesh other = torus(16, 12);
  for (const auto& v : other.vertices) mesh.vertices.push_back({8 * v[0], 8 * v[1] - 8, 8 * v[2]});
  for (auto t : other.triangles) {
    for (std::uint32_t& c : t) c += 480;
    mesh.triangles.push_back(t);
  }
  std::vector<Pair> expected;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::uint32_t j = i + 1; j < mesh.triangles.size(); ++j)
      if (intersect(mesh, i, j)) expected.push_back({i, j});
  EXPECT_GT(expected.size(), 100u);
  EXPECT_EQ(self_intersections(mesh).pairs, expected);
}

double length(const Vec3& v) {
  return std::sqrt(geometry::dot(v, v));
}

/// All triangles found are on the curve, and all of the curve is on triangles found. The number of triangles grows with
/// its square root.
TEST(SelfIntersections, OfTheKleinBottleAreAlongItsCurve) {
  const std::vector<Vec3> curve = klein_crossing(400);
  std::size_t before = 0;
  for (const std::size_t n : {40u, 80u, 160u}) {
    const TriangleMesh mesh = klein_bottle(n, n / 2);
    const SelfIntersections found = self_intersections(mesh);
    std::set<std::uint32_t> triangles;
    for (const Pair pair : found.pairs) triangles.insert({pair.a, pair.b});
    const auto centre = [&](std::uint32_t t) {
      const Triangle c = triangle_of(mesh, t);
      return geometry::times(geometry::plus(geometry::plus(c[0], c[1]), c[2]), 1.0 / 3);
    };
    const double cell = 110.0 / static_cast<double>(n);  // about the length of the centre line, and of the widest ring
    for (const std::uint32_t t : triangles) {
      double nearest = 1e9;
      for (const Vec3& p : curve) nearest = std::min(nearest, length(geometry::minus(p, centre(t))));
      ASSERT_LT(nearest, cell) << "triangle " << t << " of " << n;
    }
    for (const Vec3& p : curve) {
      double nearest = 1e9;
      for (const std::uint32_t t : triangles) nearest = std::min(nearest, length(geometry::minus(p, centre(t))));
      ASSERT_LT(nearest, cell) << p[0] << " " << p[1] << " " << p[2] << ", " << n;
    }
    if (before > 0) {
      EXPECT_GT(triangles.size(), 1.6 * static_cast<double>(before));
      EXPECT_LT(triangles.size(), 2.4 * static_cast<double>(before));
    }
    before = triangles.size();
  }
}

TEST(SelfIntersections, WhatIsSharedDoesNotCount) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}, {1, 1, 0}, {1, 1, 3}, {0, 0, 3}, {9, 9, 0}, {2, 0, 0}};
  struct Case {
    const char* what;
    std::array<std::uint32_t, 3> s, t;
    bool expected;
  };
  const Case cases[] = {
      {"side by side", {0, 1, 2}, {1, 3, 2}, false},
      {"folded over", {0, 1, 2}, {0, 1, 3}, true},
      {"folded over, and smaller", {0, 1, 2}, {0, 4, 1}, true},
      {"upright on an edge", {0, 1, 2}, {1, 0, 6}, false},
      {"upright on a corner", {0, 1, 2}, {5, 6, 0}, false},
      {"through a corner and the inside", {0, 1, 2}, {5, 4, 0}, true},
      {"opposite at a corner", {3, 1, 2}, {3, 7, 5}, false},
      {"the same", {0, 1, 2}, {2, 0, 1}, true},
      {"turned over", {0, 1, 2}, {1, 0, 2}, true},
      {"touches in a corner that is another vertex", {0, 1, 2}, {4, 5, 6}, true},
      {"a corner on the edge of the other", {0, 1, 2}, {8, 5, 6}, true},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    mesh.triangles = {c.s, c.t};
    EXPECT_EQ(intersect(mesh, 0, 1), c.expected);
    EXPECT_EQ(intersect(mesh, 1, 0), c.expected);
    EXPECT_EQ(self_intersections(mesh).pairs.size(), c.expected ? 1u : 0u);
  }
}

TEST(SelfIntersections, TrianglesWithoutAreaAreOnlyNamed) {
  TriangleMesh mesh = sphere(6, 9);
  const std::size_t sound = mesh.triangles.size();
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3& v : {Vec3{-2, 0.1, 0}, Vec3{2, 0.1, 0}, Vec3{1, 0.1, 0}}) mesh.vertices.push_back(v);
  mesh.triangles.push_back({first, first + 1, first + 2});  // through the sphere, but a line
  mesh.triangles.push_back({0, 0, 1});
  const SelfIntersections found = self_intersections(mesh);
  EXPECT_EQ(found.without_area,
            (std::vector<std::uint32_t>{static_cast<std::uint32_t>(sound), static_cast<std::uint32_t>(sound + 1)}));
  EXPECT_TRUE(found.pairs.empty());
}

TEST(SelfIntersections, RefuseWhatIsNoMesh) {
  TriangleMesh mesh = sphere(4, 5);
  EXPECT_TRUE(self_intersections({}).pairs.empty());
  mesh.vertices[3][1] = std::nan("");
  EXPECT_THROW(self_intersections(mesh), std::invalid_argument);
  mesh.vertices[3][1] = 1e-71;
  EXPECT_THROW(self_intersections(mesh), std::invalid_argument);
  mesh.vertices[3][1] = -1e71;
  EXPECT_THROW(self_intersections(mesh), std::invalid_argument);
  mesh.vertices[3][1] = 0;
  mesh.triangles[2][1] = static_cast<std::uint32_t>(mesh.vertices.size());
  EXPECT_THROW(self_intersections(mesh), std::invalid_argument);
}

/// Coordinates that no float has: boxes round outward, the test does not.
TEST(SelfIntersections, InDoublePrecision) {
  TriangleMesh mesh;
  mesh.vertices = {{0.1, 0.1, 1}, {1.1, 0.1, 1}, {0.1, 1.1, 1}, {0.3, 0.3, 1}, {0.3, 0.3, 2}, {0.4, 0.3, 2}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(self_intersections(mesh).pairs.size(), 1u);
  mesh.vertices[3][2] = std::nextafter(1.0, 2.0);
  const SelfIntersections found = self_intersections(mesh);
  EXPECT_EQ(found.pairs.size(), 0u);
  EXPECT_EQ(found.candidates, 1u);
}

std::vector<Nearest> by_all(const std::vector<Vec3>& points, const TriangleMesh& mesh) {
  std::vector<Nearest> result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const double squared = TriangleDistance(triangle_of(mesh, t)).squared(points[i], result[i].squared);
      if (squared < result[i].squared) result[i] = {squared, t};
    }
  return result;
}

void expect_same(const std::vector<Vec3>& points, const TriangleMesh& mesh, PhaseCounts& counts) {
  const auto expected = by_all(points, mesh);
  const auto phases = three_phase_distances(points, mesh, &counts), tree = NearestTriangles(mesh).nearest(points),
             both = surface_distances(points, mesh);
  ASSERT_EQ(phases.size(), points.size());
  ASSERT_EQ(tree.size(), points.size());
  ASSERT_EQ(both.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const Nearest& n : {phases[i], tree[i], both[i]}) {
      ASSERT_TRUE(same_within_rounding(n.squared, expected[i].squared, largest_side(mesh))) << i;
      // The triangle named is the one with that distance.
      ASSERT_EQ(TriangleDistance(triangle_of(mesh, n.triangle)).squared(points[i], 1e300), n.squared) << i;
    }
  }
}

TEST(SurfaceDistance, IsThatToAllTriangles) {
  PhaseCounts near, coarse, far;
  expect_same(sphere(24, 40).vertices, sphere(20, 31), near);
  EXPECT_GT(near.first_pairs, 0u);
  EXPECT_GT(near.third_pairs, 900u);
  expect_same(sphere(12, 20, 1.5).vertices, torus(40, 20), coarse);
  EXPECT_GT(coarse.late_points, 0u);
  EXPECT_GT(coarse.rounds, 1);
  std::vector<Vec3> most_near = sphere(24, 40).vertices;
  for (std::size_t i = 0; i < 5; ++i) most_near[100 * i] = geometry::times(most_near[100 * i], 9);
  expect_same(most_near, sphere(20, 31), coarse);
  EXPECT_EQ(coarse.late_points, 5u);
  TriangleMesh away = sphere(10, 12);
  for (Vec3& v : away.vertices) v = {v[0] + 40, v[1], v[2] - 3};
  expect_same(torus(16, 8).vertices, away, far);
  EXPECT_GE(far.rounds, 5);
  EXPECT_EQ(far.late_points, 128u);
}

/// A floor under small triangles: every point is in its cube, so estimates are large.
TEST(SurfaceDistance, WithAFloor) {
  TriangleMesh mesh = sphere(12, 20);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3& v : {Vec3{-90, -9, -90}, Vec3{90, -9, -90}, Vec3{0, -9, 90}}) mesh.vertices.push_back(v);
  mesh.triangles.push_back({first, first + 1, first + 2});
  PhaseCounts counts;
  expect_same(sphere(14, 23, 1.05).vertices, mesh, counts);
  EXPECT_EQ(counts.late_points, 0u);
}

TEST(SurfaceDistance, OfPointsAnywhereAndTrianglesOfAnyShape) {
  Random random(5);
  for (int round = 0; round < 12; ++round) {
    const auto point = [&](double reach) {
      return Vec3{random.between(-reach, reach), random.between(-reach, reach), random.between(-reach, reach)};
    };
    TriangleMesh mesh;
    for (int i = 0; i < 60; ++i) mesh.vertices.push_back(point(1));
    for (int i = 0; i < 80; ++i) {
      const auto corner = [&] { return static_cast<std::uint32_t>(random.index(60)); };
      mesh.triangles.push_back({corner(), corner(), corner()});
    }
    if (round == 0) mesh.triangles = {{3, 3, 3}};
    if (round == 1) mesh.triangles = {{3, 4, 3}, {5, 5, 5}};
    std::vector<Vec3> points(mesh.vertices.begin(), mesh.vertices.begin() + 10);
    for (int i = 0; i < 100; ++i) points.push_back(point(random.chance(0.5) ? 1.2 : 30));
    PhaseCounts counts;
    expect_same(points, mesh, counts);
  }
}

/// No float is as large, so boxes have no end.
TEST(SurfaceDistance, BeyondFloats) {
  TriangleMesh mesh = torus(12, 8);
  for (Vec3& v : mesh.vertices) v = geometry::times(v, 1e60);
  std::vector<Vec3> points;
  for (const Vec3& v : sphere(6, 8).vertices) points.push_back(geometry::times(v, 1.1e60));
  const auto found = NearestTriangles(mesh).nearest(points);
  const auto expected = by_all(points, mesh);
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_TRUE(same_within_rounding(found[i].squared, expected[i].squared, 1e60)) << i;
}

TEST(SurfaceDistance, KnownOnes) {
  // A large square seen from points above it and beside it.
  TriangleMesh square;
  square.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<Vec3> points{{1, 1, 3}, {2, 2, -0.5}, {4, 4, 0}, {7, 8, 0}, {-3, 2, 4}, {3, 1, 0}};
  const double squared[] = {9, 0.25, 0, 25, 25, 0};
  const auto found = three_phase_distances(points, square);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(found[i].squared, squared[i]) << i;
}

TEST(SurfaceDistance, RefusesWhatIsNoMesh) {
  EXPECT_THROW(three_phase_distances({{0, 0, 0}}, {}), std::invalid_argument);
  EXPECT_THROW(NearestTriangles({}), std::invalid_argument);
  const Vec3 bad{0, std::nan(""), 0};
  EXPECT_THROW(three_phase_distances({bad}, sphere(3, 4)), std::invalid_argument);
  EXPECT_THROW(NearestTriangles(sphere(3, 4)).nearest(std::vector<Vec3>{bad}), std::invalid_argument);
  EXPECT_THROW(surface_distances({bad}, sphere(3, 4)), std::invalid_argument);
  EXPECT_THROW(surface_distances({{0, 0, 0}}, {}), std::invalid_argument);
  EXPECT_TRUE(three_phase_distances({}, sphere(3, 4)).empty());
  EXPECT_TRUE(surface_distances({}, sphere(3, 4)).empty());
}

}  // namespace
}  // namespace boxstream::mesh::tests
