// SPDX-License-Identifier: MIT
// What narrow phases are measured against: known values, symmetries, and a computation that knows nothing of closest
// features: the largest gap over all directions.
#include "references/closed_forms.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "../../../poses/truth.hpp"
#include "narrow_phase/pose.hpp"

namespace boxstream::report {
namespace {

using Vec = Eigen::Vector3d;

RoundedBox sphere(double radius, const Vec& centre) {
  return {Eigen::Matrix3d::Identity(), centre, Vec::Zero(), radius};
}

RoundedBox capsule(double radius, double half_height, const Vec& centre, const Vec& axis = Vec::UnitZ()) {
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Vec::UnitZ(), axis).toRotationMatrix();
  return {turn, centre, {0, 0, half_height}, radius};
}

RoundedBox box(const Vec& half, const Vec& centre, const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
  return {turn, centre, half, 0};
}

double of(const RoundedBox& a, const RoundedBox& b) {
  const double forth = static_cast<double>(signed_distance(a, b)), back = static_cast<double>(signed_distance(b, a));
  EXPECT_NEAR(forth, back, 1e-16 * (1 + std::abs(forth))) << "in the other order";
  return forth;
}

TEST(ClosedForms, Spheres) {
  EXPECT_EQ(of(sphere(1, {0, 0, 0}), sphere(2, {3, 4, 0})), 2);
  EXPECT_EQ(of(sphere(1, {0, 0, 0}), sphere(2, {1, 0, 0})), -2);
  EXPECT_EQ(of(sphere(1, {5, 5, 5}), sphere(2, {5, 5, 5})), -3) << "one centre";
}

TEST(ClosedForms, Capsules) {
  const RoundedBox upright = capsule(0.5, 1, {0, 0, 0});
  EXPECT_EQ(of(upright, capsule(0.25, 1, {2, 0, 0.5})), 1.25) << "side by side";
  EXPECT_EQ(of(upright, capsule(0.25, 1, {0, 0, 4})), 1.25) << "end to end";
  EXPECT_EQ(of(upright, capsule(0.25, 1, {0, 2, 0}, Vec::UnitX())), 1.25) << "crossing";
  EXPECT_EQ(of(upright, capsule(0.25, 1, {0, 0, 0.5}, Vec::UnitX())), -0.75) << "axes meet";
  EXPECT_EQ(of(upright, capsule(0.25, 1, {0, 0, 0.5})), -0.75) << "axes lie in each other";
  EXPECT_EQ(of(upright, sphere(1, {0, 3, 5})), 3.5);
}

TEST(ClosedForms, Boxes) {
  const RoundedBox cube = box({1, 1, 1}, {0, 0, 0});
  EXPECT_EQ(of(cube, box({1, 1, 1}, {2.5, 0.5, 0})), 0.5) << "faces";
  EXPECT_EQ(of(cube, box({1, 1, 1}, {5, 6, 0})), 5) << "edges";
  EXPECT_EQ(of(cube, box({1, 1, 1}, {3, 4, 4})), 3) << "corners: 1, 2, 2";
  EXPECT_EQ(of(cube, box({1, 1, 1}, {2, 0, 0})), 0) << "touching";
  EXPECT_EQ(of(cube, box({1, 1, 1}, {1.5, 1.75, 0.5})), -0.25);
  EXPECT_EQ(of(cube, box({0.25, 0.25, 0.25}, {0.5, 0, 0})), -0.75) << "inside: out by the nearest face";
  // Two edges at right angles, seen along the diagonal between them.
  const Eigen::Matrix3d roof = Eigen::AngleAxisd(std::acos(-1.0) / 4, Vec::UnitX()).toRotationMatrix();
  const Eigen::Matrix3d gable = Eigen::AngleAxisd(std::acos(-1.0) / 4, Vec::UnitY()).toRotationMatrix();
  EXPECT_NEAR(of(box({1, 1, 1}, {0, 0, 0}, roof), box({1, 1, 1}, {0, 0, 3}, gable)), 3 - 2 * std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(of(box({1, 1, 1}, {0, 0, 0}, roof), box({1, 1, 1}, {0, 0, 2.5}, gable)), 2.5 - 2 * std::sqrt(2.0), 1e-15);
}

TEST(ClosedForms, RoundAgainstBox) {
  const RoundedBox cube = box({1, 1, 1}, {0, 0, 0});
  EXPECT_EQ(of(cube, sphere(0.5, {3, 4, 4})), std::sqrt(4.0 + 9 + 9) - 0.5);
  EXPECT_EQ(of(cube, sphere(0.5, {1.25, 0, 0})), -0.25) << "centre outside";
  EXPECT_EQ(of(cube, sphere(0.5, {0.75, 0, 0})), -0.75) << "centre inside";
  EXPECT_EQ(of(cube, capsule(0.25, 5, {2, 0, 0})), 0.75) << "longer than the box";
  EXPECT_EQ(of(cube, capsule(0.25, 5, {0.5, 0, 0})), -0.75) << "right through";
}

TEST(ClosedForms, HaveNoScaleAndNoPlace) {
  for (const narrow::Pose& pose : narrow::make_poses({"capsule-box", 1e-3, 1, false, 1, 10})) {
    RoundedBox a = pose.a, b = pose.b;
    // Powers of two, so that nothing is rounded.
    for (RoundedBox* solid : {&a, &b}) solid->half *= 0x1p-40, solid->centre *= 0x1p-40, solid->margin *= 0x1p-40;
    EXPECT_EQ(static_cast<double>(signed_distance(a, b)), pose.truth * 0x1p-40);
  }
}

poses::Solid solid_of(const RoundedBox& shape) {
  poses::Solid solid;
  solid.rotation = shape.rotation;
  solid.translation = shape.centre;
  if (shape.margin > 0) {
    solid.kind = shape.half.z() > 0 ? poses::Kind::capsule : poses::Kind::sphere;
    solid.size = {shape.margin, 2 * shape.half.z(), 0, 0};
    return solid;
  }
  for (int i = 0; i < 8; ++i)
    solid.points.push_back(shape.half.cwiseProduct(Vec(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  // Corner i has its sides in the bits of i: x, y, z.
  solid.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return solid;
}

struct Gap {
  const char* pair;
  double first_gap, last_gap;
};

class AgainstAllDirections : public testing::TestWithParam<Gap> {};

TEST_P(AgainstAllDirections, TheLargestGapIsTheDistance) {
  const auto [pair, first, last] = GetParam();
  for (const narrow::Pose& pose : narrow::make_poses({pair, first, last, false, 1, 10})) {
    const Real other = poses::signed_distance_of_convex(solid_of(pose.a), solid_of(pose.b));
    // Rotations are rounded to double: directions take columns as axes, features take the matrix as it is, and what
    // that makes grows with how far things are.
    const double extent = radius(pose.a) + radius(pose.b) + (pose.b.centre - pose.a.centre).norm();
    EXPECT_NEAR(pose.truth, static_cast<double>(other), 4e-16 * extent);
  }
}

std::vector<Gap> gaps() {
  std::vector<Gap> all;
  for (const char* pair :
       {"sphere-sphere", "sphere-capsule", "sphere-box", "capsule-capsule", "capsule-box", "box-box", "slab-slab"})
    for (const auto& [first, last] :
         {std::pair(1e-3, 3.0), {1e-12, 1e-12}, {0.0, 0.0}, {-1e-12, -1e-12}, {-1e-3, -0.3}})
      all.push_back({pair, first, last});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Pairs, AgainstAllDirections, testing::ValuesIn(gaps()), [](const auto& given) {
  std::string name = given.param.pair;
  name[name.find('-')] = '_';
  return name + "_" + std::to_string(given.index % 5);
});

}  // namespace
}  // namespace boxstream::report
