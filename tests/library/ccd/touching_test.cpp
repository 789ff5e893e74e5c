// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "checks.hpp"
#include "oracle.hpp"
#include "random_shapes.hpp"

// Shapes that share just a point, an edge or a face, and one unit in the last place more or less.
namespace boxstream::ccd_test {
namespace {

using ccd::Status;

/// Shapes that share exactly a point, a segment or a face.
struct Touch {
  const char* name;
  ccd::Shape a, b;
  Vec b_at;  ///< and one step along this axis parts them
  int axis;
};

std::vector<Touch> touches(double s) {
  ccd::ConvexHull corner{{{0, 0, 0}, {s, 0, 0}, {0, s, 0}, {0, 0, s}}};
  ccd::ConvexHull other{{{0, 0, 0}, {-s, 0, 0}, {0, -s, 0}, {0, 0, -s}}};
  const ccd::Box box{{s / 2, s / 2, s / 2}};
  return {{"faces", box, box, {s, 0, 0}, 0},
          {"faces that overlap in part", box, box, {s, s / 4, s / 8}, 0},
          {"edges", box, box, {s, s, 0}, 0},
          {"corners", box, box, {s, s, s}, 2},
          {"spheres", ccd::Sphere{s / 2}, ccd::Sphere{s / 2}, {0, s, 0}, 1},
          {"sphere and face", ccd::Sphere{s / 2}, box, {0, 0, s}, 2},
          {"capsules end to end", ccd::Capsule{s / 4, s / 2}, ccd::Capsule{s / 4, s / 2}, {0, 0, s}, 2},
          {"capsules side by side", ccd::Capsule{s / 4, s}, ccd::Capsule{s / 4, s}, {s / 2, 0, 0}, 0},
          {"cylinders face to face", ccd::Cylinder{s, s}, ccd::Cylinder{s / 2, s}, {s / 8, 0, s}, 2},
          {"cylinders side by side", ccd::Cylinder{s / 2, s}, ccd::Cylinder{s / 2, s}, {s, 0, 0}, 0},
          {"box and cylinder", box, ccd::Cylinder{s / 2, s}, {s, 0, 0}, 0},
          {"cone's foot on a box", box, ccd::Cone{s / 2, s}, {0, 0, s}, 2},
          {"apex to apex", other, corner, {0, 0, 0}, 0},
          {"hull and face", corner, box, {-s / 2, s / 8, s / 8}, 0}};
}

TEST(Touching, CountsAndIsDecided) {
  for (const double s : {1e-3, 1.0, 1e3}) {
    for (const Touch& t : touches(s)) {
      SCOPED_TRACE(std::string(t.name) + ", size " + std::to_string(s));
      const ccd::Pose here;
      const auto moved = [&](double by) {
        Vec place = t.b_at;
        place[t.axis] += place[t.axis] < 0 ? -by : by;
        return ccd::Pose(Eigen::Matrix3d::Identity(), place);
      };
      const double ulp = std::max(std::abs(t.b_at[t.axis]), s / 8) * std::numeric_limits<double>::epsilon();
      for (const double by : {0.0, -ulp, ulp, -2 * ulp, 2 * ulp}) {
        const ccd::Intersection i = intersect(t.a, here, t.b, moved(by));
        EXPECT_EQ(i.status, Status::ok) << "moved by " << by;
        if (by <= 0) {
          EXPECT_TRUE(i.intersects) << "moved by " << by;
        }
        const ccd::Distance d = distance(t.a, here, t.b, moved(by));
        EXPECT_EQ(d.status, Status::ok);
        EXPECT_LE(d.distance, 2e-6 * s);
        const ccd::Penetration p = penetration(t.a, here, t.b, moved(by));
        expect_sane(p);
        EXPECT_EQ(p.status, Status::ok);
        EXPECT_LE(p.depth, 2e-6 * s);
        if (by <= 0) {
          EXPECT_TRUE(p.intersects) << "moved by " << by;
        }
      }
      const ccd::Pose apart = moved(1e-4 * s);
      EXPECT_FALSE(intersect(t.a, here, t.b, apart).intersects);
      EXPECT_NEAR(distance(t.a, here, t.b, apart).distance, 1e-4 * s,
                  std::string(t.name) == "edges" || std::string(t.name) == "corners" ? 1e-5 * s : 2e-6 * s);
      EXPECT_FALSE(penetration(t.a, here, t.b, apart).intersects);
    }
  }
}

/// The same contacts turned and far out, where touching is a matter of the last digits: everything is decided, and
/// nothing that overlaps by 1e-9 of its size is missed.
TEST(Touching, TurnedAndFarOut) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomShapes random(seed);
    const double s = random.size(1e-3, 1e3);
    const Eigen::Matrix3d turn = random.rotation();
    const Vec place = random.direction() * (seed % 2 == 0 ? 0 : 100 * s);
    for (const Touch& t : touches(s)) {
      SCOPED_TRACE(std::string(t.name) + ", seed " + std::to_string(seed));
      const ccd::Pose here(turn, place);
      const auto moved = [&](double by) {
        Vec local = t.b_at;
        local[t.axis] += local[t.axis] < 0 ? -by : by;
        return ccd::Pose(turn, place + turn * local);
      };
      for (const double by : {-1e-9, -1e-13, 0.0, 1e-13, 1e-4}) {
        const ccd::Intersection i = intersect(t.a, here, t.b, moved(by * s));
        const ccd::Penetration p = penetration(t.a, here, t.b, moved(by * s));
        EXPECT_EQ(i.status, Status::ok) << "moved by " << by;
        EXPECT_EQ(p.status, Status::ok) << "moved by " << by << ", depth " << p.depth << " by " << name(p.method);
        expect_sane(p);
        EXPECT_LE(p.depth, 2e-6 * s);
        // libccd's EPA may be sure of a depth that is far too large here, or a whole side of the shape.
        ccd::Options by_gjk;
        by_gjk.solver = ccd::Options::Solver::gjk;
        const ccd::Penetration q = penetration(t.a, here, t.b, moved(by * s), by_gjk);
        EXPECT_TRUE(q.status != Status::ok || q.depth <= 2e-6 * s) << "moved by " << by << ", depth " << q.depth;
        if (by == -1e-9) {
          EXPECT_TRUE(i.intersects && p.intersects);
        } else if (by == 1e-4) {
          EXPECT_FALSE(i.intersects || p.intersects);
        } else {
          EXPECT_LE(distance(t.a, here, t.b, moved(by * s)).distance, 2e-6 * s);
        }
      }
    }
  }
}

/// Moved together until their closest points meet, so mostly at corners and edges, where the directions that part them
/// are few and no face has them.
TEST(Touching, AtTheirClosestPoints) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomShapes random(seed);
    const ccd::Shape a = random.shape(5, 1), b = random.shape(seed % 2 == 0 ? 0 : 5, 1);
    const ccd::Pose pose_a = random.pose(Vec::Zero(), 0), far = random.pose(6 * random.direction(), 0);
    const ccd::Distance apart = distance(a, pose_a, b, far);
    const Vec gap = apart.on_b - apart.on_a;
    for (const double left : {1e-12, 1e-15, 0.0, -1e-15, -1e-12}) {
      const ccd::Pose pose_b(far.rotation, far.translation - gap + left * gap.normalized());
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", gap " << left);
      const ccd::Penetration p = penetration(a, pose_a, b, pose_b);
      EXPECT_EQ(p.status, ccd::Status::ok) << p.depth << " by " << name(p.method);
      EXPECT_LE(p.depth, 2e-6);
    }
  }
}

/// Faces are not square to the columns of a matrix that is only nearly a rotation, and on a large box that shows.
TEST(Touching, WithMatricesThatAreNearlyRotations) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomShapes random(seed);
    const ccd::Box a{{300, 200, 100}}, b{{0.5, 0.3, 0.4}};
    const auto rough = [&](ccd::Pose pose) {
      for (double& x : pose.rotation.reshaped()) x += random.range(-1e-5, 1e-5);
      return pose;
    };
    const ccd::Pose pose_a = rough(random.pose(Vec::Zero(), 0));
    const Vec on_face = pose_a.rotation * Vec(random.range(-290, 290), random.range(-190, 190), 100);
    const ccd::Pose pose_b = rough(random.pose(on_face, 0.2));
    const double expected = least_way_out(a, pose_a, b, pose_b);
    ASSERT_GT(expected, 0);
    const ccd::Penetration p = penetration(a, pose_a, b, pose_b);
    EXPECT_EQ(p.status, ccd::Status::ok);
    EXPECT_NEAR(p.depth, expected, 4e-6) << "seed " << seed << ", by " << name(p.method);
  }
}

}  // namespace
}  // namespace boxstream::ccd_test
