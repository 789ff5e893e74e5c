// SPDX-License-Identifier: MIT
#include "symmetric_pairs.hpp"

#include <gtest/gtest.h>
#include <time.h>

#include <optional>

#include "checks.hpp"
#include "oracle.hpp"

// Where all directions are nearly equal: all pairs of kinds on one centre, on one axis and nearly so.
namespace boxstream::ccd_test {
namespace {

constexpr double tolerance = 1e-6;  // the default, as a fraction of the smaller size

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The least way out from a formula, or from trying all there is to try; where neither is, it is looked for.
double known_depth(const PosedPair& pair, RandomShapes& random) {
  const auto* const ball = std::get_if<ccd::Sphere>(&pair.a);
  const auto* const other_ball = std::get_if<ccd::Sphere>(&pair.b);
  if (ball || other_ball) {
    const ccd::Shape& other = ball ? pair.b : pair.a;
    const ccd::Pose& pose = ball ? pair.pose_b : pair.pose_a;
    const Vec centre = ball ? pair.pose_a.translation : pair.pose_b.translation;
    const double radius = ball ? ball->radius : other_ball->radius;
    if (const auto* const box = std::get_if<ccd::Box>(&other)) return radius - point_to_box(centre, *box, pose);
    if (const auto* const cylinder = std::get_if<ccd::Cylinder>(&other))
      return radius - point_to_cylinder(centre, *cylinder, pose);
    if (const auto* const cone = std::get_if<ccd::Cone>(&other)) return radius - point_to_cone(centre, *cone, pose);
  }
  const auto is_flat = [](const ccd::Shape& shape) {
    return std::holds_alternative<ccd::Box>(shape) || std::holds_alternative<ccd::ConvexHull>(shape);
  };
  if (is_flat(pair.a) && is_flat(pair.b)) return least_way_out(pair.a, pair.pose_a, pair.b, pair.pose_b);
  return searched_way_out(pair.a, pair.pose_a, pair.b, pair.pose_b, random);
}

/// What the contract calls the size: the radius of a sphere around the shape's own middle.
struct Size {
  double operator()(const ccd::Box& b) const { return b.half_extents.norm(); }
  double operator()(const ccd::Sphere& s) const { return s.radius; }
  double operator()(const ccd::Capsule& c) const { return c.radius + c.height / 2; }
  double operator()(const ccd::Cylinder& c) const { return std::hypot(c.radius, c.height / 2); }
  double operator()(const ccd::Cone& c) const { return std::hypot(c.radius, c.height / 2); }
  double operator()(const ccd::ConvexHull& h) const {
    Vec low = h.points.front(), high = low;
    for (const Vec& point : h.points) low = low.cwiseMin(point), high = high.cwiseMax(point);
    double radius = 0;
    for (const Vec& point : h.points) radius = std::max(radius, (point - (low + high) / 2).norm());
    return radius;
  }
};

class OfTwoKinds : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(OfTwoKinds, DeepInOneAnother) {
  const auto [kind_a, kind_b] = GetParam();
  for (std::uint64_t seed = 1; seed <= 70; ++seed) {
    RandomShapes random(seed);
    const double scale = seed % 4 == 0 ? 1e-6 : seed % 4 == 1 ? 1e6 : 1;
    PosedPair pair = symmetric_pair(kind_a, kind_b, seed, scale);
    // Far out, too: the geometry is that of the poses as rounded.
    const Vec far = seed % 3 == 0 ? Vec(1e6 * scale * random.direction()) : Vec(Vec::Zero());
    pair.pose_a.translation += far;
    pair.pose_b.translation += far;
    SCOPED_TRACE(pair.what);
    const double begun = processor_seconds();
    const ccd::Penetration p = penetration(pair.a, pair.pose_a, pair.b, pair.pose_b);
    EXPECT_LT(processor_seconds() - begun, 0.2);
    expect_sane(p);
    EXPECT_EQ(p.status, ccd::Status::ok) << p.depth << " by " << name(p.method);
    // Formulas see places in the world with 53 bits.
    const double rounding = 1e-12 * scale + 1e-15 * far.norm();
    const double least = std::max(0.0, known_depth(pair, random));
    EXPECT_LE(p.depth - least, tolerance * std::min(std::visit(Size{}, pair.a), std::visit(Size{}, pair.b)) + rounding)
        << name(p.method);
    if (p.intersects) {
      EXPECT_NEAR(p.depth, std::max(0.0, way_out(pair.a, pair.pose_a, pair.b, pair.pose_b, p.direction)), rounding);
    } else {
      EXPECT_LE(least, rounding);
    }
    ccd::Options by_gjk;
    by_gjk.solver = ccd::Options::Solver::gjk;
    by_gjk.max_iterations = 100;
    const ccd::Penetration q = penetration(pair.a, pair.pose_a, pair.b, pair.pose_b, by_gjk);
    EXPECT_TRUE(q.status != ccd::Status::ok || q.depth <= p.depth + 2 * tolerance * scale)
        << q.depth << " for " << p.depth;
    EXPECT_EQ(intersect(pair.a, pair.pose_a, pair.b, pair.pose_b).status, ccd::Status::ok);
    EXPECT_EQ(distance(pair.a, pair.pose_a, pair.b, pair.pose_b).status, ccd::Status::ok);
  }
}

std::vector<std::pair<int, int>> pairs_of_kinds() {
  std::vector<std::pair<int, int>> pairs;
  for (int a = 0; a < RandomShapes::kinds; ++a)
    for (int b = 0; b < RandomShapes::kinds; ++b) pairs.emplace_back(a, b);
  return pairs;
}

std::string name_of_kinds(const testing::TestParamInfo<std::pair<int, int>>& info) {
  std::string name = std::string(kind_names[info.param.first]) + "_" + kind_names[info.param.second];
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Symmetric, OfTwoKinds, testing::ValuesIn(pairs_of_kinds()), name_of_kinds);

/// Hulls of many points are round, too; the depth is at most that along any direction, and all are tried that a face of
/// one with itself turned to and fro can have.
TEST(SymmetricHulls, OfManyPointsWithThemselves) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomShapes random(seed);
    const ccd::Shape ball = ball_of_points(random, 400, 1);
    const ccd::Penetration p = penetration(ball, {}, ball, {});
    EXPECT_EQ(p.status, ccd::Status::ok);
    EXPECT_NEAR(p.depth, way_out(ball, {}, ball, {}, p.direction), 1e-12);
    EXPECT_LE(p.depth, searched_way_out(ball, {}, ball, {}, random) + tolerance);
  }
}

}  // namespace
}  // namespace boxstream::ccd_test
