// SPDX-License-Identifier: MIT
#include "formats/import/convex_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "formats/import/clip.hpp"
#include "formats/import/geometry.hpp"
#include "sanitized.hpp"
#include "solids.hpp"

namespace boxstream::import_test {
namespace {

using imports::convex_hull;
using imports::convex_parts;
using imports::ConvexParts;
using imports::Facet;
using imports::Hull;

/// How far `point` is outside of the hull; negative inside.
double outside(const Hull& hull, const Vec3& point) {
  double most = -1e300;
  for (const auto& t : hull.triangles) {
    const Vec3& a = hull.points[t[0]];
    const Vec3 n = imports::cross(imports::minus(hull.points[t[1]], a), imports::minus(hull.points[t[2]], a));
    const double length = std::sqrt(imports::dot(n, n));
    if (length > 1e-12) most = std::max(most, imports::dot(n, imports::minus(point, a)) / length);
  }
  return most;
}

/// The largest distance of a vertex of the mesh from the nearest hull.
double uncovered(const TriangleMesh& mesh, const ConvexParts& parts) {
  double worst = 0;
  for (const Vec3& v : mesh.vertices) {
    double nearest = 1e300;
    for (const Hull& hull : parts.hulls) nearest = std::min(nearest, outside(hull, v));
    worst = std::max(worst, nearest);
  }
  return worst;
}

double volume_of(const ConvexParts& parts) {
  double sum = 0;
  for (const Hull& hull : parts.hulls) sum += hull.volume;
  return sum;
}

std::vector<Facet> facets_of(const TriangleMesh& mesh) {
  std::vector<Facet> facets;
  for (const auto& t : mesh.triangles)
    facets.push_back({{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}});
  return facets;
}

TEST(Solid, HasTheVolumeAndCentroidOfATetrahedron) {
  TriangleMesh mesh = tetrahedron();
  for (Vec3& v : mesh.vertices) v[0] += 1000;
  const imports::Solid solid = imports::measure(mesh.vertices, mesh.triangles);
  EXPECT_NEAR(solid.volume, 1, 1e-12);
  EXPECT_NEAR(solid.centroid[0], 1000.25, 1e-9);
  EXPECT_NEAR(solid.centroid[1], 0.5, 1e-12);
  EXPECT_NEAR(solid.centroid[2], 0.75, 1e-12);
}

TEST(Solid, KnowsWhetherItIsClosed) {
  TriangleMesh mesh = ell();
  EXPECT_TRUE(imports::is_closed(mesh.triangles));
  mesh.triangles.pop_back();
  EXPECT_FALSE(imports::is_closed(mesh.triangles));
}

TEST(Clip, SharesTheVolumeOut) {
  const auto halves = imports::clip(facets_of(tetrahedron()), 2, 1.5);  // half way up: the tip is an eighth
  EXPECT_NEAR(imports::signed_volume(halves.high), 1.0 / 8, 1e-12);
  EXPECT_NEAR(imports::signed_volume(halves.low), 7.0 / 8, 1e-12);
}

TEST(Clip, ClosesCutsOfAnyShapeAgainAndAgain) {
  const TriangleMesh ring = torus(2, 0.5, 24, 12);
  const auto facets = facets_of(ring);
  const double whole = imports::signed_volume(facets);
  const auto first = imports::clip(facets, 0, 0.3);       // two discs
  const auto second = imports::clip(first.low, 1, -1.9);  // a bean
  const auto third = imports::clip(second.high, 2, 0.1);  // a ring in part
  EXPECT_NEAR(imports::signed_volume(first.high) + imports::signed_volume(second.low) +
                  imports::signed_volume(third.low) + imports::signed_volume(third.high),
              whole, 1e-9);
  EXPECT_GT(imports::signed_volume(third.high), 0);
}

TEST(ConvexHull, OfACubeWithPointsInsideHasItsCorners) {
  TriangleMesh cube;
  add_box(cube, {10, 10, 10}, {11, 12, 13});
  cube.vertices.push_back({10.5, 11, 11});
  const auto hull = convex_hull(cube.vertices);
  ASSERT_TRUE(hull);
  EXPECT_EQ(hull->points.size(), 8u);
  EXPECT_NEAR(hull->volume, 6, 1e-9);
  EXPECT_NEAR(hull->centroid[2], 11.5, 1e-9);
}

TEST(ConvexHull, OfAPlaneIsNone) {
  EXPECT_FALSE(convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 0}}));
  EXPECT_FALSE(convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(ConvexHull, WithTooManyCornersKeepsTheOutermost) {
  constexpr int rows = tests::sanitized ? 40 : 80;
  std::vector<Vec3> ball;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < rows; ++j) {
      const double y = -1 + (2 * i + 1.0) / rows, angle = 2 * std::numbers::pi * (j + 0.5 * (i % 2)) / rows;
      const double r = std::sqrt(1 - y * y);
      ball.push_back({r * std::cos(angle), y, r * std::sin(angle)});
    }
  }
  const auto hull = convex_hull(ball);
  ASSERT_TRUE(hull);
  EXPECT_LE(hull->points.size(), imports::most_hull_points);
  EXPECT_GT(hull->points.size(), 500u);
  EXPECT_NEAR(hull->volume, 4 * std::numbers::pi / 3, 0.03 * 4 * std::numbers::pi / 3);
}

TEST(ConvexParts, OfAConvexMeshAreOne) {
  const ConvexParts parts = convex_parts(tetrahedron(), {16, 0.01});
  ASSERT_EQ(parts.hulls.size(), 1u);
  ASSERT_TRUE(parts.error);
  EXPECT_NEAR(*parts.error, 0, 1e-9);
}

TEST(ConvexParts, OfAnLAreTwoBoxes) {
  const ConvexParts parts = convex_parts(ell(), {16, 0.01});
  ASSERT_EQ(parts.hulls.size(), 2u);
  EXPECT_NEAR(*parts.error, 0, 1e-3);
  EXPECT_NEAR(volume_of(parts), 3, 3e-3);
  EXPECT_LT(uncovered(ell(), parts), 1e-3);
}

TEST(ConvexParts, KeepToTheErrorAskedFor) {
  const TriangleMesh ring = tests::sanitized ? torus(1, 0.35, 20, 10) : torus(1, 0.35, 32, 16);
  const double volume = imports::measure(ring.vertices, ring.triangles).volume;
  const ConvexParts parts = convex_parts(ring, {64, 0.15});
  ASSERT_TRUE(parts.error);
  EXPECT_LE(*parts.error, 0.15);
  EXPECT_NEAR(*parts.error, volume_of(parts) / volume - 1, 1e-12);  // what is said is what is there
  EXPECT_GT(parts.hulls.size(), 4u);
  EXPECT_LT(uncovered(ring, parts), 3e-4);  // of an extent of 2.7: the lattice of the hulls
}

TEST(ConvexParts, KeepToTheNumberOfHulls) {
  const TriangleMesh ring = tests::sanitized ? torus(1, 0.35, 20, 10) : torus(1, 0.35, 32, 16);
  double last = 1e300;
  for (const std::size_t most : {1u, 2u, 4u, 8u}) {
    if (tests::sanitized && most > 1) break;
    const ConvexParts parts = convex_parts(ring, {most, 0});
    EXPECT_EQ(parts.hulls.size(), most);
    EXPECT_LT(uncovered(ring, parts), 3e-4);
    EXPECT_LT(*parts.error, most == 2 ? last + 1e-3 : last);  // halves of a ring fill as much as the whole
    last = *parts.error;
  }
}

TEST(ConvexParts, OfAMeshWithAHoleInItsSurfaceHaveNoError) {
  TriangleMesh open = ell();
  open.triangles.pop_back();
  const ConvexParts parts = convex_parts(open, {16, 0.01});
  EXPECT_FALSE(parts.error);
  EXPECT_EQ(parts.hulls.size(), 2u);
  EXPECT_LT(uncovered(open, parts), 1e-3);
}

TEST(ConvexParts, OfNothingSolidAreRefused) {
  const TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
  EXPECT_THROW(convex_parts(flat, {}), std::runtime_error);
  EXPECT_THROW(convex_parts(torus(1, 0.3, 200, 60), {}), std::runtime_error);  // 24 000 triangles
}

}  // namespace
}  // namespace boxstream::import_test
