// SPDX-License-Identifier: MIT
// The two measures of tightness, where their values are known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "papers/volumes/builders.hpp"
#include "papers/volumes/objects.hpp"
#include "papers/volumes/tightness.hpp"
#include "support.hpp"

namespace boxstream::papers::volumes::tests {
namespace {

using Surface = std::vector<Triangle>;

constexpr double measure_tolerance = 0.01;

template <class V>
Hierarchy<V> over(const Objects& objects, std::size_t leaf_size) {
  return Hierarchy<V>(build(Builder::median, objects, leaf_size), objects);
}

template <class V>
double tightness_of(const Surface& surface) {
  const Objects objects = Objects::of(surface);
  return hausdorff_tightness(
      over<V>(objects, 4), 0, objects,
      [&](std::uint32_t object, const Point& p) { return distance_to_triangle(objects.corners(object), p); },
      measure_tolerance);
}

/// side x side squares of two triangles each, spanned by two edges.
Surface sheet(const Point& u, const Point& v, int side) {
  return triangulated_fields(side, side, [&](int i, int j, float(&out)[3]) {
    const Point p = (i * u + j * v) / side;
    for (int d = 0; d < 3; ++d) out[d] = static_cast<float>(p[d]);
  });
}

/// Figure 45: a sheet across the diagonal of its AABB. Two edges of the box are 1 / sqrt(2) off the sheet; half of the
/// sheet is no tighter enclosed. An OBB lies in the sheet's plane.
TEST(HausdorffTightness, OfASheetAcrossTheDiagonal) {
  const Point u(1, 1, 0), v(0, 0, 1);
  const double expected = std::sqrt(0.5) / std::sqrt(3);
  EXPECT_NEAR(tightness_of<AxisBox>(sheet(u, v, 8)), expected, measure_tolerance);
  EXPECT_NEAR(tightness_of<AxisBox>(sheet(u / 2, v / 2, 4)), expected, measure_tolerance);
  EXPECT_NEAR(tightness_of<Dop<18>>(sheet(u, v, 8)), 0, measure_tolerance);
  // Within the plane it is turned a little, as the corners of the triangles are not spread quite evenly.
  EXPECT_LE(tightness_of<OrientedBox>(sheet(u, v, 8)), 0.03);
  // The circumscribed sphere's pole, above the middle of the sheet.
  EXPECT_NEAR(tightness_of<Sphere>(sheet(u, v, 8)), 0.5, measure_tolerance);
}

/// Figure 46: of an arc of 2 phi, which here is swept along an axis for as long as its own chord, the OBB is
/// (1 - cos phi) thick, and so half an arc about twice as tight.
TEST(HausdorffTightness, OfAnArc) {
  for (const double phi : {0.8, 0.4, 0.2, 0.1}) {
    constexpr int side = 16;
    const double width = 2 * std::sin(phi);
    Surface surface = sheet({1, 0, 0}, {0, 0, 1}, side);
    for (Triangle& triangle : surface)
      for (auto& corner : triangle.corners) {
        const double angle = (2 * corner[0] - 1) * phi;
        corner[0] = static_cast<float>(std::sin(angle));
        corner[1] = static_cast<float>(std::cos(angle));
        corner[2] = static_cast<float>(corner[2] * width);
      }
    const double diameter = width * std::numbers::sqrt2;
    // The farthest point is the middle of the box's lower face, beneath the arc's top. The arc is of 16 chords.
    EXPECT_NEAR(tightness_of<OrientedBox>(surface), (1 - std::cos(phi)) / diameter, measure_tolerance) << phi;
  }
}

TEST(HausdorffTightness, OfAPointIsNoNumber) {
  EXPECT_TRUE(std::isnan(tightness_of<Sphere>({{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}}})));
}

/// Against points all over the triangle.
TEST(TriangleDistance, IsThatOfTheNearestPoint) {
  Random random(1);
  const auto point = [&] { return Point(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)); };
  for (int round = 0; round < 200; ++round) {
    std::vector<Point> corners{point(), point(), point()};
    if (round % 10 == 1) corners[2] = corners[0] + 2 * (corners[1] - corners[0]);
    if (round % 10 == 2) corners[1] = corners[2] = corners[0];
    const Point p = 2 * point();
    double nearest = 10;
    constexpr int steps = 60;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const double u = double(i) / steps, v = double(j) / steps;
        nearest = std::min(nearest, (corners[0] * (1 - u - v) + corners[1] * u + corners[2] * v - p).norm());
      }
    const double found = distance_to_triangle(corners, p);
    EXPECT_LE(found, nearest + 1e-12);
    EXPECT_GE(found, nearest - 4.0 / steps);
    if (round % 10 == 2) {
      EXPECT_NEAR(found, nearest, 1e-12);
    }
  }
}

template <class V>
class NearestTest : public ::testing::Test {};
TYPED_TEST_SUITE(NearestTest, AllVolumes);

TYPED_TEST(NearestTest, IsThatOfBruteForce) {
  Random random(2);
  Surface surface(60);
  for (Triangle& triangle : surface)
    for (auto& corner : triangle.corners)
      for (float& x : corner) x = static_cast<float>(random.between(-1, 1));
  const Objects objects = Objects::of(surface);
  for (const Builder builder : builders()) {
    const Hierarchy<TypeParam> hierarchy(build(builder, objects, 2), objects);
    for (int round = 0; round < 50; ++round) {
      const Point p(random.between(-2, 2), random.between(-2, 2), random.between(-2, 2));
      const auto distance = [&](std::uint32_t object) { return distance_to_triangle(objects.corners(object), p); };
      const auto node = static_cast<std::uint32_t>(random.index(hierarchy.tree().nodes.size()));
      double expected = 100;
      for (const std::uint32_t object : hierarchy.tree().objects(node)) expected = std::min(expected, distance(object));
      ASSERT_EQ(distance_to_nearest(hierarchy, node, p, distance), expected) << name(builder);
    }
  }
}

/// Four unit cubes in a row, the second and third one apart, the others touching: 5 x 1 x 1 around all.
TEST(VolumeTightness, OfARow) {
  std::vector<Aabb> boxes;
  for (const float x : {0.F, 1.F, 3.F, 4.F}) boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  const VolumeTightness tightness = volume_tightness(over<AxisBox>(Objects::of(boxes), 1));
  ASSERT_EQ(tightness.by_children.size(), 7u);
  EXPECT_DOUBLE_EQ(tightness.by_children[0], 5.0 / 4);
  EXPECT_DOUBLE_EQ(tightness.by_leaves[0], 5.0 / 4);
  EXPECT_DOUBLE_EQ(tightness.by_children[1], 1);
  EXPECT_TRUE(std::isnan(tightness.by_children[6]));
  boxes[3] = {{6, 0, 0}, {7, 1, 1}};
  const VolumeTightness looser = volume_tightness(over<AxisBox>(Objects::of(boxes), 1));
  EXPECT_DOUBLE_EQ(looser.by_children[0], 7.0 / 6);
  EXPECT_DOUBLE_EQ(looser.by_leaves[0], 7.0 / 4);
  EXPECT_DOUBLE_EQ(looser.by_children[2], 2);
  for (Aabb& box : boxes) box.max[2] = 0;
  EXPECT_TRUE(std::isnan(volume_tightness(over<AxisBox>(Objects::of(boxes), 1)).by_children[0]));
}

}  // namespace
}  // namespace boxstream::papers::volumes::tests
