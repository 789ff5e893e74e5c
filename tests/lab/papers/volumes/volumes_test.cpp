// SPDX-License-Identifier: MIT
// Each kind of bounding volume for itself.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <numbers>

#include "support.hpp"

namespace boxstream::papers::volumes::tests {
namespace {

using Cloud = std::vector<Point>;

/// Of any place, size, flatness and direction; coordinates are floats.
Cloud cloud(Random& random) {
  const double size = std::pow(10, random.between(-20, 20));
  const double offset = random.chance(0.5) ? 0 : size * std::pow(10, random.between(0, 6));
  const int flat = random.integer(0, 3);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(random.between(0, 6), Point(random.unit(), random.unit(), 1).normalized()).toRotationMatrix();
  const Point middle = offset * Point(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
  Cloud points;
  for (std::size_t i = 1 + random.index(30); i > 0; --i) {
    Point p(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    for (int d = 0; d < flat; ++d) p[d] = 0;
    p = middle + size * (turn * p);
    points.push_back(p.cast<float>().cast<double>());
  }
  return points;
}

template <class V>
class VolumeTest : public ::testing::Test {};
TYPED_TEST_SUITE(VolumeTest, AllVolumes);

TYPED_TEST(VolumeTest, EnclosesPoints) {
  Random random(1);
  for (int round = 0; round < 600; ++round) {
    const Cloud points = cloud(random);
    const TypeParam v = TypeParam::around(Points(points));
    const AxisBox bounds{v.bounds()};
    for (const Point& p : points) {
      ASSERT_TRUE(inside(v, p)) << "round " << round << ": " << p.transpose();
      ASSERT_LE(v.excess(p), 0) << "round " << round;
      ASSERT_TRUE(inside(bounds, p)) << "round " << round;
    }
    ASSERT_TRUE(v.volume() >= 0 && v.area() >= 0) << "round " << round;
  }
}

TYPED_TEST(VolumeTest, EnclosesWhatIsMerged) {
  Random random(2);
  for (int round = 0; round < 150; ++round) {
    std::vector<Cloud> clouds;
    std::vector<TypeParam> volumes;
    for (std::size_t i = 1 + random.index(4); i > 0; --i) {
      clouds.push_back(cloud(random));
      volumes.push_back(TypeParam::around(Points(clouds.back())));
    }
    // Merging again and again must not lose anything either.
    TypeParam merged = TypeParam::around(Span<const TypeParam>(volumes));
    for (int again = 0; again < 20; ++again) merged = TypeParam::around(Span<const TypeParam>(&merged, 1));
    for (const Cloud& points : clouds)
      for (const Point& p : points) ASSERT_TRUE(inside(merged, p)) << "round " << round;
  }
}

/// Of the same size as one made around all points, where that is promised.
TYPED_TEST(VolumeTest, MergesExactly) {
  Random random(9);
  for (int round = 0; round < 150; ++round) {
    Cloud all = cloud(random), rest = cloud(random);
    const TypeParam volumes[] = {TypeParam::around(Points(all)), TypeParam::around(Points(rest))};
    all.insert(all.end(), rest.begin(), rest.end());
    const TypeParam merged = TypeParam::around(Span<const TypeParam>(volumes)), fresh = TypeParam::around(Points(all));
    if (TypeParam::merges_exactly) {
      EXPECT_EQ(merged.volume(), fresh.volume());
      EXPECT_EQ(merged.area(), fresh.area());
      EXPECT_TRUE(merged.bounds() == fresh.bounds());
    }
    for (const Point& p : all) EXPECT_TRUE(inside(merged, p) && inside(fresh, p));
  }
}

TYPED_TEST(VolumeTest, OverlapsWhereAPointIsCommon) {
  Random random(3);
  for (int round = 0; round < 600; ++round) {
    Cloud a = cloud(random), b = cloud(random);
    b.push_back(a[random.index(a.size())]);
    const TypeParam v = TypeParam::around(Points(a)), w = TypeParam::around(Points(b));
    ASSERT_TRUE(overlap(v, w)) << "round " << round;
    ASSERT_TRUE(overlap(w, v)) << "round " << round;
    ASSERT_TRUE(overlap(v, v)) << "round " << round;
  }
}

TYPED_TEST(VolumeTest, ExcessIsALowerBoundOfTheDistance) {
  Random random(4);
  for (int round = 0; round < 150; ++round) {
    const Cloud points = cloud(random);
    const TypeParam v = TypeParam::around(Points(points));
    const double size = (Point(v.bounds().max) - Point(v.bounds().min)).norm();
    const Point p = points[0] + 3 * size * Point(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    for (const Point& q : points) ASSERT_LE(v.excess(p), (p - q).norm()) << "round " << round;
    ASSERT_EQ(v.excess(p) > 0, !inside(v, p)) << "round " << round;
  }
}

/// Of cubes far enough apart along any of the volume's own directions or between them.
TYPED_TEST(VolumeTest, IsClearOfWhatIsFarOff) {
  Cloud cube;
  for (int i = 0; i < 8; ++i) cube.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  const TypeParam v = TypeParam::around(Points(cube));
  Random random(5);
  for (int round = 0; round < 150; ++round) {
    const Point way = Point(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)).normalized() * 1.8;
    Cloud moved;
    for (const Point& p : cube) moved.push_back(p + way);
    // Circumscribed spheres are sqrt(3) apart then.
    const bool clear = way.cwiseAbs().maxCoeff() > 1 + 1e-9 || TypeParam::name() == "sphere";
    ASSERT_EQ(overlap(v, TypeParam::around(Points(moved))), !clear) << way.transpose();
  }
}

Cloud with_all_signs(const Cloud& points) {
  Cloud all;
  for (const Point& p : points)
    for (int i = 0; i < 8; ++i) all.emplace_back(i & 1 ? p[0] : -p[0], i & 2 ? p[1] : -p[1], i & 4 ? p[2] : -p[2]);
  return all;
}

template <class V>
void expect_size(const Cloud& points, double volume, double area) {
  const V v = V::around(Points(points));
  EXPECT_NEAR(v.volume(), volume, 1e-12 * volume) << V::name();
  EXPECT_NEAR(v.area(), area, 1e-12 * area) << V::name();
}

/// Polytopes whose faces are all of a kind's directions are what it makes of their corners.
TEST(VolumeSizes, AreThoseOfKnownPolytopes) {
  const double root2 = std::numbers::sqrt2, root3 = std::numbers::sqrt3, pi = std::numbers::pi;
  const Cloud cube = with_all_signs({{1, 1, 1}});
  expect_size<AxisBox>(cube, 8, 24);
  expect_size<OrientedBox>(cube, 8, 24);
  expect_size<Dop<14>>(cube, 8, 24);
  expect_size<Dop<18>>(cube, 8, 24);
  expect_size<Dop<26>>(cube, 8, 24);
  expect_size<Sphere>(cube, 4 * root3 * pi, 12 * pi);
  const Cloud octahedron = with_all_signs({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  expect_size<Dop<14>>(octahedron, 4.0 / 3, 4 * root3);
  expect_size<Dop<26>>(octahedron, 4.0 / 3, 4 * root3);
  const Cloud cuboctahedron = with_all_signs({{1, 1, 0}, {1, 0, 1}, {0, 1, 1}});
  expect_size<Dop<14>>(cuboctahedron, 20.0 / 3, 12 + 4 * root3);
  const Cloud rhombic_dodecahedron = with_all_signs({{1, 1, 1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}});
  expect_size<Dop<18>>(rhombic_dodecahedron, 16, 24 * root2);
  expect_size<Dop<26>>(rhombic_dodecahedron, 16, 24 * root2);
  const Cloud line{{0, 0, 0}, {0, 0, 3}};
  expect_size<AxisBox>(line, 0, 0);
  expect_size<Sphere>(line, 4.5 * pi, 9 * pi);
}

TEST(VolumeSizes, MoreSlabsAreNeverLooser) {
  Random random(6);
  for (int round = 0; round < 150; ++round) {
    const Cloud points = cloud(random);
    const double box = AxisBox::around(Points(points)).volume() * (1 + 1e-6),
                 d14 = Dop<14>::around(Points(points)).volume(), d18 = Dop<18>::around(Points(points)).volume(),
                 d26 = Dop<26>::around(Points(points)).volume();
    const double rounding = 1e-9 * std::pow(AxisBox::around(Points(points)).area(), 1.5);
    EXPECT_LE(d14, box + rounding);
    EXPECT_LE(d18, box + rounding);
    EXPECT_LE(d26, std::min(d14, d18) * (1 + 1e-6) + rounding);
  }
}

TEST(OrientedBoxes, FollowATurn) {
  Random random(7);
  for (int round = 0; round < 100; ++round) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(random.between(0, 6), Point(random.unit(), random.unit(), 1).normalized()).toRotationMatrix();
    Cloud points;
    for (const Point& p : with_all_signs({{3, 2, 1}})) points.push_back(turn * p);
    const OrientedBox v = OrientedBox::around(Points(points));
    EXPECT_NEAR(v.volume(), 48, 1e-10);
    EXPECT_NEAR(v.area(), 88, 1e-10);
  }
}

Point nearest(const OrientedBox& box, const Point& p) {
  const Point along = box.axes.transpose() * (p - box.centre);
  return box.centre + box.axes * along.cwiseMax(-box.half).cwiseMin(box.half);
}

double extent(const OrientedBox& box, const Point& direction) {
  return (box.axes.transpose() * direction).cwiseAbs().dot(box.half);
}

/// Going to and fro between the nearest points of two boxes ends at the two that are nearest to each other, or at a
/// common one; in the first case, the line through them separates the boxes, which is checked, in the second they
/// overlap: nothing of that is how `overlap` does it.
TEST(OrientedBoxes, OverlapIsRight) {
  Random random(8);
  int clear = 0, common = 0;
  for (int round = 0; round < 1500; ++round) {
    const auto box = [&] {
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(random.between(0, 6), Point(random.unit(), random.unit(), 1).normalized())
              .toRotationMatrix();
      return OrientedBox{{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)},
                         turn,
                         {random.unit(), random.unit(), random.chance(0.2) ? 0 : random.unit()}};
    };
    const OrientedBox a = box(), b = box();
    Point p = a.centre, q = b.centre;
    for (int i = 0; i < 300; ++i) {
      q = nearest(b, p);
      p = nearest(a, q);
    }
    const Point way = q - p;
    if (way.norm() < 1e-12) {
      ++common;
      ASSERT_TRUE(overlap(a, b)) << "round " << round;
    } else if (way.dot(b.centre - a.centre) > extent(a, way) + extent(b, way) + 1e-12) {
      ++clear;
      ASSERT_FALSE(overlap(a, b)) << "round " << round;
    }
  }
  EXPECT_GT(clear, 300);
  EXPECT_GT(common, 300);
}

}  // namespace
}  // namespace boxstream::papers::volumes::tests
