// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "random_shapes.hpp"

namespace boxstream::ccd_test {
namespace {

using Wide = long double;

/// How far the shape reaches up and down one axis, in the wider arithmetic, from the numbers as stored.
std::array<Wide, 2> wide_reach(const ccd::Shape& shape, const ccd::Pose& pose, int axis) {
  const Wide x = pose.rotation(axis, 0), y = pose.rotation(axis, 1), z = pose.rotation(axis, 2);
  const Wide across = std::sqrt(x * x + y * y), all = std::sqrt(x * x + y * y + z * z);
  std::array<Wide, 2> r{};
  const auto both = [&](Wide reach) { r = {-reach, reach}; };
  if (const auto* const b = std::get_if<ccd::Box>(&shape)) {
    both(std::abs(x) * b->half_extents.x() + std::abs(y) * b->half_extents.y() + std::abs(z) * b->half_extents.z());
  } else if (const auto* const s = std::get_if<ccd::Sphere>(&shape)) {
    both(all * s->radius);
  } else if (const auto* const c = std::get_if<ccd::Capsule>(&shape)) {
    both(all * c->radius + std::abs(z) * c->height / 2);
  } else if (const auto* const l = std::get_if<ccd::Cylinder>(&shape)) {
    both(across * l->radius + std::abs(z) * l->height / 2);
  } else if (const auto* const k = std::get_if<ccd::Cone>(&shape)) {
    const Wide apex = z * k->height / 2, rim = across * k->radius;
    r = {std::min(apex, -apex - rim), std::max(apex, -apex + rim)};
  } else {
    r = {1e300L, -1e300L};
    for (const Vec& p : std::get<ccd::ConvexHull>(shape).points) {
      const Wide reach = x * p.x() + y * p.y() + z * p.z();
      r = {std::min(r[0], reach), std::max(r[1], reach)};
    }
  }
  return {r[0] + pose.translation[axis], r[1] + pose.translation[axis]};
}

TEST(Bounds, ContainTheShapeAndAreTight) {
  for (int kind = 0; kind < RandomShapes::kinds; ++kind) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      RandomShapes random(seed);
      const double scale = random.size(1e-3, 1e3);
      const double far = seed % 3 == 0 ? 0 : seed % 3 == 1 ? 1 : 1e6;
      const ccd::Shape shape = random.shape(kind, scale);
      ccd::Pose pose = random.pose(Vec(far, -far, far / 3), scale);
      if (seed % 10 == 0) pose.rotation = Eigen::Matrix3d::Identity();
      const Aabb64 box = bounds(shape, pose);
      for (int d = 0; d < 3; ++d) {
        const auto [low, high] = wide_reach(shape, pose, d);
        SCOPED_TRACE(testing::Message() << "kind " << kind << ", seed " << seed << ", axis " << d);
        EXPECT_LE(static_cast<Wide>(box.min[d]), low);
        EXPECT_GE(static_cast<Wide>(box.max[d]), high);
        const Wide slack = 2e-16L * (64 * scale + 4 * (far + scale));
        EXPECT_GE(static_cast<Wide>(box.min[d]), low - slack);
        EXPECT_LE(static_cast<Wide>(box.max[d]), high + slack);
      }
    }
  }
}

/// Pairs of shapes that touch have boxes that overlap, so a broad phase over these boxes loses nothing.
TEST(Bounds, ShapesThatTouchHaveBoxesThatTouch) {
  int touching = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    RandomShapes random(seed);
    const ccd::Shape a = random.shape(static_cast<int>(seed % 6), 1),
                     b = random.shape(static_cast<int>(seed / 6 % 6), 1);
    const ccd::Pose pose_a = random.pose(Vec::Zero(), 1), pose_b = random.pose(Vec::Zero(), 4);
    if (distance(a, pose_a, b, pose_b).distance > 0) continue;
    ++touching;
    EXPECT_TRUE(overlaps(bounds(a, pose_a), bounds(b, pose_b))) << "seed " << seed;
  }
  EXPECT_GT(touching, 200);
}

TEST(Poses, FromEigensTransforms) {
  const Eigen::Isometry3d t = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.5, Vec::UnitY());
  const ccd::Pose pose = t;
  EXPECT_EQ(pose.rotation, t.linear());
  EXPECT_EQ(pose.translation, t.translation());
  const ccd::Pose narrow = t.cast<float>();
  EXPECT_TRUE(is_valid(bounds(ccd::Sphere{1}, narrow)));
  EXPECT_NEAR(narrow.rotation(0, 2), pose.rotation(0, 2), 1e-7);
  EXPECT_EQ(alignof(ccd::Pose), alignof(double)) << "layout must not follow the compiler's flags";
  EXPECT_EQ(sizeof(ccd::Pose), 12 * sizeof(double));
}

/// What rounds a shape is as large whatever a matrix that is a rotation but for rounding makes of it.
TEST(Bounds, HoldRoundShapesUnderMatricesThatAreRotationsButForRounding) {
  for (const double scale : {0.99996, 1.00004}) {
    ccd::Pose one, other;
    one.rotation *= scale;
    other.rotation *= scale;
    for (const ccd::Shape& shape : {ccd::Shape{ccd::Sphere{1}}, ccd::Shape{ccd::Capsule{1, 1}}})
      for (const double apart : {1.9999, 1.99995, 1.99999}) {
        other.translation.x() = apart;
        const auto answer = intersect(shape, one, shape, other);
        if (!answer.intersects) continue;
        EXPECT_TRUE(overlaps(bounds(shape, one), bounds(shape, other))) << scale << ", " << apart;
      }
  }
}

}  // namespace
}  // namespace boxstream::ccd_test
