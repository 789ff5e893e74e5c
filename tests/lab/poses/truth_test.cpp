// SPDX-License-Identifier: MIT
// The truth that solvers are held against, against formulas.
#include "truth.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "every_pose.hpp"
#include "faces.hpp"

namespace boxstream::poses {
namespace {

struct Truth : testing::TestWithParam<HardPose> {};

TEST_P(Truth, IsWhatIsWritten) {
  const HardPose& pose = GetParam();
  const double rounding = (is_exact(pose.a, pose.b) ? 1e-15 : 1e-12) * std::max(1.0, extent(pose.a, pose.b));
  EXPECT_NEAR(static_cast<double>(signed_distance(pose.a, pose.b)), pose.truth, rounding) << pose.known;
  EXPECT_NEAR(static_cast<double>(signed_distance(pose.b, pose.a)), pose.truth, rounding) << "the other way round";
}

BOXSTREAM_FOR_EVERY_POSE(Truth);

Solid round(Kind kind, double radius, double height, const Eigen::Vector3d& place = Eigen::Vector3d::Zero(),
            const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
  Solid solid;
  solid.kind = kind;
  solid.size = {radius, height, 0, 0};
  solid.translation = place;
  solid.rotation = turn;
  return solid;
}

Eigen::Matrix3d about_x(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
}

/// Where the best direction is none of those that are always tried.
TEST(TruthOfRoundShapes, AgainstFormulas) {
  const auto of = [](const Solid& a, const Solid& b) { return static_cast<double>(signed_distance(a, b)); };
  const Solid cylinder = round(Kind::cylinder, 1, 2), cone = round(Kind::cone, 1, 2);
  // Beyond the rim: a point in a plane through the axis.
  EXPECT_NEAR(of(cylinder, round(Kind::sphere, 0.25, 0, {4, 0, 5})), 5 - 0.25, 1e-12);
  EXPECT_NEAR(of(cylinder, round(Kind::sphere, 0.25, 0, {0, -4, -5})), 5 - 0.25, 1e-12);
  // In front of the side of a cone, whose normal is (2, 1) / sqrt(5).
  EXPECT_NEAR(of(cone, round(Kind::sphere, 0, 0, {0.5 + 2, 0, 1})), std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(of(cone, round(Kind::sphere, 0, 0, {0, 0, -0.9})), -0.1, 1e-12);
  // Crossed cylinders: sides that touch along no edge.
  EXPECT_NEAR(of(cylinder, round(Kind::cylinder, 1, 2, {2.5, 0, 0}, about_x(1))), 0.5, 1e-12);
  EXPECT_NEAR(of(cylinder, round(Kind::cylinder, 1, 2, {1.75, 0, 0}, about_x(1))), -0.25, 1e-12);
  // A cylinder leans by an angle over a plane: its lowest point is on its rim.
  const double lowest = std::cos(0.3) + std::sin(0.3);
  Solid plane = round(Kind::half_space, 0, 0);
  plane.size = {0, 0, 1, -2};
  EXPECT_NEAR(of(plane, round(Kind::cylinder, 1, 2, {0, 0, 0}, about_x(0.3))), 2 - lowest, 1e-15);
}

TEST(TruthOfSolids, IsExactInTheLastDigits) {
  for (const HardPose& pose : all()) {
    if (pose.name != "boxes_flush_side_by_side") continue;
    Solid b = pose.b;
    for (const double gap : {1e-16, 2.5e-16, 1e-15, 1e-7}) {
      b.translation.x() = 1 + gap;
      EXPECT_EQ(static_cast<double>(signed_distance(pose.a, b)), (1 + gap) - 1);
      b.translation.x() = 1 - gap;
      EXPECT_EQ(static_cast<double>(signed_distance(pose.a, b)), (1 - gap) - 1);
    }
    return;
  }
  FAIL() << "no such pose";
}

TEST(Faces, OfHullsAreClosed) {
  int hulls = 0;
  for (const HardPose& pose : all())
    for (const Solid* const solid : {&pose.a, &pose.b}) {
      if (solid->faces.empty()) continue;
      ++hulls;
      // Each edge is there once in each direction, and Euler's formula holds.
      std::set<std::pair<int, int>> edges;
      for (const std::vector<int>& face : solid->faces)
        for (std::size_t i = 0; i < face.size(); ++i)
          EXPECT_TRUE(edges.insert({face[i], face[(i + 1) % face.size()]}).second) << pose.name;
      for (const auto& [i, j] : edges) EXPECT_TRUE(edges.count({j, i})) << pose.name;
      EXPECT_EQ(solid->points.size() + solid->faces.size(), edges.size() / 2 + 2) << pose.name;
    }
  EXPECT_GT(hulls, 40);
}

}  // namespace
}  // namespace boxstream::poses
