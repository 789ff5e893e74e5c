// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "checks.hpp"
#include "oracle.hpp"
#include "random_shapes.hpp"

// Degenerate shapes, bad input, too few iterations, and what libccd gets wrong.
namespace boxstream::ccd_test {
namespace {

using ccd::Status;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double giant = 1.7e308;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

ccd::Pose at(double x, double y, double z) {
  return {Eigen::Matrix3d::Identity(), {x, y, z}};
}

ccd::Pose turned(double degrees, const Vec& axis, const Vec& place) {
  return {Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()).toRotationMatrix(), place};
}

/// libccd's GJK answers depth 0 and direction NaN here.
TEST(LibccdIsWrong, CubesOfSide2AtDistance1_9) {
  const ccd::Box cube{{1, 1, 1}};
  for (const auto solver : {ccd::Options::Solver::automatic, ccd::Options::Solver::gjk, ccd::Options::Solver::mpr}) {
    ccd::Options options;
    options.solver = solver;
    for (int axis = 0; axis < 3; ++axis) {
      Vec place = Vec::Zero();
      place[axis] = 1.9;
      const ccd::Penetration p = penetration(cube, at(0, 0, 0), cube, {Eigen::Matrix3d::Identity(), place}, options);
      expect_sane(p);
      EXPECT_TRUE(p.intersects);
      EXPECT_GE(p.depth, 0.1 - 1e-9);
      if (solver != ccd::Options::Solver::mpr && p.status == Status::ok) {
        EXPECT_NEAR(p.depth, 0.1, 1e-6);
        EXPECT_NEAR(p.direction[axis], 1, 1e-6);
      }
      if (solver == ccd::Options::Solver::automatic) {
        EXPECT_EQ(p.status, Status::ok);
      }
    }
  }
}

/// FCL on libccd gives a normal of zero.
TEST(LibccdIsWrong, BoxAndCylinderTouchWithANormal) {
  const ccd::Penetration p = penetration(ccd::Box{{0.5, 0.5, 0.5}}, at(0, 0, 0), ccd::Cylinder{0.5, 1}, at(0, 0, 1));
  EXPECT_TRUE(p.intersects);
  EXPECT_NEAR(p.direction.z(), 1, 1e-6);
  EXPECT_NEAR(p.depth, 0, 1e-9);
}

/// Where libccd's EPA may not terminate: cylinders on boxes. And two unit boxes 4 apart, where FCL on libccd is 5 %
/// off.
TEST(LibccdIsWrong, CylindersOnBoxesEnd) {
  const auto begun = std::chrono::steady_clock::now();
  const ccd::Box table{{0.5, 0.5, 0.05}};
  for (int i = 0; i < 400; ++i) {
    const double depth = i % 20 * 1e-4, degrees = i / 20;
    const ccd::Penetration p = penetration(table, at(0, 0, 0), ccd::Cylinder{0.1, 0.2},
                                           turned(degrees, {1, 0.2, 0}, {0.1, 0.07, 0.15 - depth}));
    expect_sane(p);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(20));
  EXPECT_NEAR(distance(ccd::Box{{0.5, 0.5, 0.5}}, at(0, 0, 0), ccd::Box{{0.5, 0.5, 0.5}}, at(0, 4, 0)).distance, 3,
              1e-9);
}

TEST(Degenerate, FlatThinAndEmptyShapes) {
  const ccd::Box sheet{{1, 1, 0}}, rod{{1, 0, 0}}, point_box{{0, 0, 0}}, cube{{1, 1, 1}};
  const ccd::Sphere point{0};
  struct Case {
    const char* name;
    ccd::Shape a, b;
    ccd::Pose b_pose;
    double expected;  ///< distance, or minus the depth
  } const cases[] = {
      {"sheets that cross", sheet, sheet, turned(90, {1, 0, 0}, {0, 0, 0.25}), -0.75},
      {"sheets that coincide", sheet, sheet, at(0.5, 0, 0), 0},
      {"parallel sheets", sheet, sheet, at(0.5, 0, 2), 2},
      {"a rod through a sheet", sheet, rod, turned(90, {0, 1, 0}, {0.2, 0.3, 0.4}), -0.6},
      {"rods that cross", rod, rod, turned(90, {0, 0, 1}, {0.1, 0, 0}), 0},
      {"a point in a cube", cube, point, at(0.5, 0.25, 0), -0.5},
      {"a point box in a cube", cube, point_box, at(0.5, 0.25, 0), -0.5},
      {"the same point", point, point, at(0, 0, 0), 0},
      {"two points", point, point_box, at(3, 4, 0), 5},
      {"spheres on one centre", ccd::Sphere{1}, ccd::Sphere{2}, at(0, 0, 0), -3},
      {"a sphere on a segment", ccd::Capsule{0, 2}, ccd::Sphere{0.5}, at(0, 0, 0.3), -0.5},
      {"capsules that cross", ccd::Capsule{0.25, 2}, ccd::Capsule{0.5, 2}, turned(90, {1, 0, 0}, {0, 0, 0.1}), -0.75},
      {"capsules on one line", ccd::Capsule{0.25, 2}, ccd::Capsule{0.5, 2}, at(0, 0, 0.5), -0.75},
      {"a disc and a cube", ccd::Cylinder{1, 0}, cube, at(0, 0, 1.5), 0.5},
      {"a needle and a cube", ccd::Cone{0, 2}, cube, at(0, 0, 1.5), -0.5},
      {"a hull of one point", ccd::ConvexHull{{{1, 0, 0}}}, cube, at(4, 0, 0), 2},
      {"a hull of one point, many times", ccd::ConvexHull{std::vector<Vec>(20, Vec(1, 0, 0))}, cube, at(0.5, 0, 0),
       -0.5},
      {"a flat hull", ccd::ConvexHull{{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 0, 0}, {1, 1, 0}}}, cube,
       at(0, 0, 0.75), -0.25},
      {"flat hulls in one plane", ccd::ConvexHull{{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}}},
       ccd::ConvexHull{{{1, 1, 0}, {1, -1, 0}, {-1, -1, 0}}}, at(0.1, 0.2, 0), 0},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const ccd::Distance d = distance(c.a, at(0, 0, 0), c.b, c.b_pose);
    EXPECT_EQ(d.status, Status::ok);
    EXPECT_NEAR(d.distance, std::max(0.0, c.expected), 1e-6);
    const ccd::Intersection i = intersect(c.a, at(0, 0, 0), c.b, c.b_pose);
    EXPECT_EQ(i.status, Status::ok);
    EXPECT_EQ(i.intersects, c.expected <= 0);
    const ccd::Penetration p = penetration(c.a, at(0, 0, 0), c.b, c.b_pose);
    expect_sane(p);
    EXPECT_EQ(p.intersects, c.expected <= 0);
    EXPECT_NEAR(p.depth, std::max(0.0, -c.expected), 1e-6) << name(p.method);
  }
}

TEST(Degenerate, TinyBesideHugeAndFarOut) {
  const ccd::Box ground{{1e3, 1e3, 1}};
  for (const double far : {0.0, 1e7}) {
    const ccd::Pose here = at(far, far, 0);
    const ccd::Penetration p = penetration(ground, here, ccd::Box{{1e-3, 1e-3, 1e-3}}, at(far + 3, far - 5, 1.0005));
    EXPECT_TRUE(p.intersects);
    EXPECT_NEAR(p.depth, 5e-4, 1e-8);
    EXPECT_NEAR(p.direction.z(), 1, 1e-6);
    const ccd::Distance d = distance(ground, here, ccd::Sphere{1e-3}, at(far + 3, far - 5, 1.002));
    EXPECT_NEAR(d.distance, 1e-3, 1e-8);
  }
  EXPECT_NEAR(distance(ccd::Sphere{1e-200}, at(0, 0, 0), ccd::Sphere{1}, at(3, 0, 0)).distance, 2, 1e-6);
  const ccd::Distance huge =
      distance(ccd::Sphere{1e150}, at(0, 0, 0), ccd::Box{{1e150, 1e150, 1e150}}, at(4e150, 0, 0));
  EXPECT_NEAR(huge.distance, 2e150, 1e145);
}

TEST(BadInput, IsAStatus) {
  const ccd::Sphere ball{1};
  const ccd::Shape bad_shapes[] = {ccd::Sphere{-1},
                                   ccd::Sphere{nan},
                                   ccd::Box{{1, infinity, 1}},
                                   ccd::Box{{1, 1, -1e-9}},
                                   ccd::Capsule{1, nan},
                                   ccd::Cylinder{-1, 1},
                                   ccd::Cone{1, -1},
                                   ccd::ConvexHull{},
                                   ccd::ConvexHull{{{0, 0, nan}}},
                                   ccd::Box{{nan, 1, 1}},
                                   ccd::Box{{giant, giant, giant}},
                                   ccd::Capsule{giant, giant},
                                   ccd::ConvexHull{{{giant, giant, giant}}}};
  const auto refused = [&](const ccd::Shape& a, const ccd::Pose& pose, const ccd::Options& options = {}) {
    for (const bool swap : {false, true}) {
      const ccd::Shape x = swap ? ccd::Shape(ball) : a, y = swap ? a : ccd::Shape(ball);
      const ccd::Pose p = swap ? ccd::Pose() : pose, q = swap ? pose : ccd::Pose();
      const ccd::Penetration deep = penetration(x, p, y, q, options);
      EXPECT_EQ(deep.status, Status::invalid_input);
      expect_sane(deep);
      EXPECT_EQ(intersect(x, p, y, q, options).status, Status::invalid_input);
      EXPECT_FALSE(intersect(x, p, y, q, options).intersects);
      EXPECT_EQ(distance(x, p, y, q, options).status, Status::invalid_input);
    }
  };
  for (const ccd::Shape& shape : bad_shapes) {
    refused(shape, {});
    EXPECT_FALSE(is_valid(bounds(shape, {})));
  }
  ccd::Pose mirrored, stretched, unturned;
  unturned.rotation(2, 1) = nan;
  mirrored.rotation(0, 0) = -1;
  stretched.rotation(1, 1) = 1.01;
  for (const ccd::Pose& pose : {at(nan, 0, 0), at(0, infinity, 0), mirrored, stretched, unturned}) {
    refused(ball, pose);
    EXPECT_FALSE(is_valid(bounds(ball, pose)));
  }
  ccd::Options options;
  for (const double t : {0.0, -1.0, nan, infinity}) options.tolerance = t, refused(ball, {}, options);
  options = {};
  options.max_iterations = 0;
  refused(ball, {}, options);

  // Legal alone, and too large together.
  const ccd::Sphere largest{giant};
  EXPECT_EQ(intersect(largest, {}, ball, at(giant, 0, 0)).status, Status::invalid_input);
  EXPECT_EQ(penetration(largest, {}, ball, at(giant, 0, 0)).status, Status::invalid_input);
}

/// With few iterations there is an answer, a status, and bounds that hold.
TEST(IterationLimit, IsAStatusAndTheBoundsHold) {
  int limited = 0, limited_apart = 0, limited_libccd = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    RandomShapes random(seed);
    const ccd::Shape a = random.shape(static_cast<int>(seed % 6), 1),
                     b = random.shape(3 + static_cast<int>(seed % 3), 1);
    const ccd::Pose pose_a = random.pose(Vec::Zero(), 0), pose_b = random.pose(Vec::Zero(), 3);
    const ccd::Distance full = distance(a, pose_a, b, pose_b);
    ASSERT_EQ(full.status, Status::ok);
    const ccd::Penetration deepest = penetration(a, pose_a, b, pose_b);
    ASSERT_EQ(deepest.status, Status::ok);
    for (const int iterations : {1, 2, 3, 5, 8, 20}) {
      for (const auto solver :
           {ccd::Options::Solver::automatic, ccd::Options::Solver::gjk, ccd::Options::Solver::mpr}) {
        ccd::Options options;
        options.max_iterations = iterations;
        options.solver = solver;
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", iterations " << iterations);
        const ccd::Penetration p = penetration(a, pose_a, b, pose_b, options);
        expect_sane(p);
        if (full.distance == 0) {
          EXPECT_TRUE(p.intersects);
        }
        if (p.intersects) {
          EXPECT_NEAR(p.depth, std::max(0.0, way_out(a, pose_a, b, pose_b, p.direction)), 1e-9);
        }
        if (p.status == Status::ok) {
          EXPECT_FALSE(p.intersects && full.distance > 2e-6) << "it is sure of shapes that are apart";
          if (p.intersects && solver != ccd::Options::Solver::mpr) {
            EXPECT_NEAR(p.depth, deepest.depth, 4e-6) << "it is sure of a way out that is not the least";
          }
        }
        limited += p.status == Status::iteration_limit;
        const ccd::Intersection i = intersect(a, pose_a, b, pose_b, options);
        limited_libccd += i.status == Status::iteration_limit && solver != ccd::Options::Solver::automatic;
        if (full.distance == 0) {
          EXPECT_TRUE(i.intersects);
        }
        if (i.status == Status::ok && full.distance > 2e-6) {
          EXPECT_FALSE(i.intersects);
        }
        const ccd::Distance d = distance(a, pose_a, b, pose_b, options);
        EXPECT_GE(d.distance, full.lower_bound - 1e-12);
        EXPECT_LE(d.lower_bound, full.distance + 1e-12);
        limited_apart += d.status == Status::iteration_limit;
      }
    }
  }
  EXPECT_GT(limited, 100);
  EXPECT_GT(limited_apart, 100);
  EXPECT_GT(limited_libccd, 100);
}

TEST(Names, OfEveryValue) {
  EXPECT_STREQ(name(Status::ok), "ok");
  EXPECT_STREQ(name(Status::inexact), "inexact");
  EXPECT_STREQ(name(Status::iteration_limit), "iteration limit");
  EXPECT_STREQ(name(Status::invalid_input), "invalid input");
  EXPECT_STREQ(name(ccd::Method::none), "none");
  EXPECT_STREQ(name(ccd::Method::cores), "cores");
  EXPECT_STREQ(name(ccd::Method::gjk), "gjk");
  EXPECT_STREQ(name(ccd::Method::epa), "epa");
  EXPECT_STREQ(name(ccd::Method::mpr), "mpr");
  EXPECT_STREQ(name(ccd::Method::axes), "axes");
  EXPECT_EQ(ccd::real_size(), sizeof(double)) << "Debian's libccd";
}

}  // namespace
}  // namespace boxstream::ccd_test
