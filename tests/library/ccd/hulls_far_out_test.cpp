// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "checks.hpp"
#include "oracle.hpp"
#include "symmetric_pairs.hpp"

// Hulls given away from their own origin, as meshes in world coordinates are, and poses far out: sizes and tolerances
// are those of the shapes, wherever they are.
namespace boxstream::ccd_test {
namespace {

using Wide = long double;
using WideVec = Eigen::Matrix<Wide, 3, 1>;

constexpr double tolerance = 1e-6;  // the default, as a fraction of the smaller size
constexpr double rounding = 3e-14;  // of the largest length, as Options::tolerance has it

/// A hull around the origin of its points as stored; its points given elsewhere; a pose that brings it back.
struct Moved {
  ccd::ConvexHull around_origin;
  ccd::ConvexHull given;
  Vec by;
};

/// Differences from `by` are exact: the points are rounded where they are given.
Moved move_points(const ccd::ConvexHull& hull, const Vec& by) {
  Moved moved{{}, {}, by};
  for (const Vec& point : hull.points) {
    moved.given.points.push_back(point + by);
    moved.around_origin.points.push_back(moved.given.points.back() - by);
  }
  return moved;
}

double size_of(const ccd::ConvexHull& hull) {
  double most = 0;
  for (const Vec& point : hull.points) most = std::max(most, point.norm());
  return most;
}

/// How far B begins beyond the end of A along a direction: never above the distance.
double wide_gap(const ccd::ConvexHull& a, const ccd::Pose& pose_a, const ccd::ConvexHull& b, const ccd::Pose& pose_b,
                const Vec& direction) {
  const WideVec unit = direction.cast<Wide>().normalized();
  Wide end = -1e300L, begin = 1e300L;
  const auto reach = [&](const Vec& point, const ccd::Pose& pose) {
    return unit.dot(WideVec(pose.rotation.cast<Wide>() * point.cast<Wide>() +
                            (pose.translation.cast<Wide>() - pose_a.translation.cast<Wide>())));
  };
  for (const Vec& point : a.points) end = std::max(end, reach(point, pose_a));
  for (const Vec& point : b.points) begin = std::min(begin, reach(point, pose_b));
  return static_cast<double>(begin - end);
}

/// The distance is held from both sides: no gap along the direction between the closest points is wider than the true
/// distance, and the distance that is answered is never below it.
void check_apart(const ccd::ConvexHull& a, const ccd::Pose& pose_a, const ccd::ConvexHull& b, const ccd::Pose& pose_b,
                 const Vec& direction, double allowed) {
  const ccd::Distance d = distance(a, pose_a, b, pose_b);
  ASSERT_EQ(d.status, ccd::Status::ok);
  ASSERT_GT(d.distance, 0);
  const double gap =
      std::max(wide_gap(a, pose_a, b, pose_b, d.on_b - d.on_a), wide_gap(a, pose_a, b, pose_b, direction));
  EXPECT_NEAR(d.distance, gap, allowed);
  EXPECT_LE(d.lower_bound, gap + allowed);
  EXPECT_FALSE(intersect(a, pose_a, b, pose_b).intersects);
  EXPECT_FALSE(penetration(a, pose_a, b, pose_b).intersects);
}

TEST(HullsFarOut, BallsOfManyPointsInWorldCoordinates) {
  for (const double far : {0.0, 1.0, 1e2, 1e4, 1e6}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      RandomShapes random(seed);
      SCOPED_TRACE(testing::Message() << "at " << far << ", seed " << seed);
      const Vec place = far * random.direction(), direction = random.direction();
      const double allowed = tolerance * 1.01 + 4 * rounding * far;
      const Moved a = move_points(ball_of_points(random, 400, 1), place);
      const ccd::ConvexHull ball = ball_of_points(random, 400, 1);
      const Moved apart = move_points(ball, place + 2.5 * direction), deep = move_points(ball, place + 0.4 * direction);
      check_apart(a.given, {}, apart.given, {}, direction, allowed);

      const ccd::Penetration p = penetration(a.given, {}, deep.given, {});
      EXPECT_EQ(p.status, ccd::Status::ok);
      EXPECT_TRUE(intersect(a.given, {}, deep.given, {}).intersects);
      EXPECT_NEAR(p.depth, -wide_gap(a.given, {}, deep.given, {}, p.direction), 4 * rounding * far + 1e-12);
      // The same shapes, each around the origin, differ by nothing but the place.
      const ccd::Pose pose_b(Eigen::Matrix3d::Identity(), deep.by - a.by);
      EXPECT_LE(p.depth, searched_way_out(a.around_origin, {}, deep.around_origin, pose_b, random) + allowed);
      EXPECT_NEAR(p.depth, penetration(a.around_origin, {}, deep.around_origin, pose_b).depth, allowed);
    }
  }
}

/// Small hulls, whose depth is known from trying all directions, of sizes from 1e-6 to 1e6 and up to a thousand apart;
/// far out by points, by pose, or by one against the other.
TEST(HullsFarOut, AreWhatTheyAreNearby) {
  int deep = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    RandomShapes random(seed);
    const double scale = random.size(1e-6, 1e6), other_scale = scale * random.size(1e-3, 1);
    const double far = seed % 5 == 0 ? 0 : scale * random.size(1, 1e6);
    const Vec by_a = far * random.direction(), by_b = seed % 2 == 0 ? by_a : Vec(far * random.direction());
    const Moved a = move_points(ball_of_points(random, 8, scale), by_a);
    const Moved b = move_points(ball_of_points(random, 8, other_scale), by_b);
    // Where the hulls' own middles go.
    const ccd::Pose pose_a = random.pose(seed % 3 == 0 ? Vec(Vec::Zero()) : Vec(far * random.direction()), 0);
    const ccd::Pose near_b(random.rotation(), random.range(0, 1.5) * (scale + other_scale) * random.direction());
    const ccd::Pose pose_b(near_b.rotation,
                           pose_a.translation + pose_a.rotation * by_a + near_b.translation - near_b.rotation * by_b);
    // Both hulls around the origin, and all that rounding does to where they are.
    const ccd::Pose at_a(pose_a.rotation, Vec::Zero());
    const WideVec middle = pose_b.rotation.cast<Wide>() * by_b.cast<Wide>() + pose_b.translation.cast<Wide>() -
                           pose_a.rotation.cast<Wide>() * by_a.cast<Wide>() - pose_a.translation.cast<Wide>();
    const ccd::Pose at_b(pose_b.rotation, middle.cast<double>());
    const double size = std::min(size_of(a.around_origin), size_of(b.around_origin));
    const double allowed = 1.01 * tolerance * size + rounding * (4 * far + 4 * scale);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", size " << size << ", at " << far);
    const double expected = least_way_out(a.around_origin, at_a, b.around_origin, at_b);
    if (std::abs(expected) < 2 * allowed) continue;
    if (expected < 0) {
      ++apart;
      check_apart(a.given, pose_a, b.given, pose_b, near_b.translation, allowed);
      continue;
    }
    ++deep;
    EXPECT_TRUE(intersect(a.given, pose_a, b.given, pose_b).intersects);
    EXPECT_EQ(distance(a.given, pose_a, b.given, pose_b).distance, 0);
    const ccd::Penetration p = penetration(a.given, pose_a, b.given, pose_b);
    EXPECT_EQ(p.status, ccd::Status::ok);
    EXPECT_NEAR(p.depth, expected, allowed) << name(p.method);
    EXPECT_NEAR((p.on_a - p.on_b).dot(p.direction), p.depth, 2 * allowed + 1e-15 * pose_a.translation.norm());
  }
  EXPECT_GT(deep, 100);
  EXPECT_GT(apart, 100);
}

/// All kinds with hulls in world coordinates, far from the hull's origin but not from the shape.
TEST(HullsFarOut, WithEveryKind) {
  for (int kind = 0; kind < RandomShapes::kinds; ++kind) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      RandomShapes random(seed);
      const double far = random.size(1, 1e6);
      const Vec place = far * random.direction();
      const ccd::Shape shape = random.shape(kind, 1);
      const ccd::Pose pose = random.pose(place, 2), nearby(pose.rotation, pose.translation - place);
      const Moved hull = move_points(ball_of_points(random, 12, 1), place);
      SCOPED_TRACE(testing::Message() << "kind " << kind << ", seed " << seed << ", at " << far);
      const double allowed = 2e-6 + 8 * rounding * far;
      const ccd::Distance d = distance(hull.given, {}, shape, pose),
                          e = distance(hull.around_origin, {}, shape, nearby);
      EXPECT_EQ(d.status, ccd::Status::ok);
      EXPECT_NEAR(d.distance, e.distance, allowed);
      const ccd::Penetration p = penetration(hull.given, {}, shape, pose);
      EXPECT_EQ(p.status, ccd::Status::ok);
      if (!p.intersects) continue;
      EXPECT_NEAR(p.depth, std::max(0.0, way_out(hull.around_origin, {}, shape, nearby, p.direction)), allowed);
      EXPECT_LE(p.depth, std::max(0.0, searched_way_out(hull.around_origin, {}, shape, nearby, random)) + allowed);
    }
  }
}

}  // namespace
}  // namespace boxstream::ccd_test
