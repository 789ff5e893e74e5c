// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>

#include "narrow_phase/pose.hpp"
#include "narrow_phase/round_mesh.hpp"

namespace boxstream::report::narrow {
namespace {

TEST(NarrowPoses, HaveTheGapThatIsAskedFor) {
  for (const char* pair : {"sphere-box", "capsule-capsule", "box-box", "slab-slab", "ball-pill"})
    for (const double gap : {-0.2, -1e-9, 0.0, 1e-9, 0.5})
      for (const double scale : {1e-6, 1.0, 1e5})
        for (const Pose& pose : make_poses({pair, gap, gap, false, scale, 3})) {
          EXPECT_NEAR(pose.truth / pose.size, gap, 2e-15) << pair << " scale " << scale;
          EXPECT_LE(pose.size, 2 * scale);
          EXPECT_GE(pose.size, 0.3 * scale);
        }
}

TEST(NarrowPoses, SpreadGapsInTheirLogarithm) {
  const auto poses = make_poses({"box-box", -1e-4, -1e-1, false, 1, 30});
  int below = 0;
  for (const Pose& pose : poses) below += pose.truth / pose.size > -1e-3;
  EXPECT_EQ(below, 10);
}

TEST(NarrowPoses, HaveBothSignsIfAsked) {
  const auto poses = make_poses({"capsule-box", 1e-3, 1e-1, true, 1, 10});
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(poses[i].truth < 0, i % 2 == 1);
}

TEST(NarrowPoses, AreTheSameForTheSameWish) {
  const auto one = make_poses({"box-box", 0.1, 0.1, false, 1, 5}),
             other = make_poses({"box-box", 0.1, 0.1, false, 1, 5});
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].b.centre, other[i].b.centre);
}

TEST(NarrowPoses, LayASlabFlush) {
  for (const Pose& pose : make_poses({"slab-slab", 1e-3, 1e-3, false, 1, 10})) {
    EXPECT_EQ(pose.a.rotation, pose.b.rotation);
    const Eigen::Vector3d apart = pose.a.rotation.transpose() * (pose.b.centre - pose.a.centre);
    EXPECT_NEAR(apart.y(), pose.a.half.y() + pose.b.half.y() + 1e-3 * pose.size, 1e-14);
  }
}

TEST(NarrowPoses, RefuseWhatIsNoPair) {
  EXPECT_THROW(make_poses({"box-box", 0, 0, false, 1, 0}), std::invalid_argument);
  EXPECT_THROW(make_poses({"box", 0, 0, false, 1, 1}), std::invalid_argument);
  EXPECT_THROW(make_poses({"box-cone", 0, 0, false, 1, 1}), std::invalid_argument);
  EXPECT_THROW(make_poses({"slab-box", 0, 0, false, 1, 1}), std::invalid_argument);
}

TEST(RoundMesh, IsClosedAndOnTheSphere) {
  for (const int triangles : {20, 80, 320}) {
    const Mesh mesh = sphere_mesh(triangles);
    EXPECT_EQ(static_cast<int>(mesh.triangles.size()), triangles);
    EXPECT_EQ(static_cast<int>(mesh.points.size()), 2 + triangles / 2) << "Euler: V - E + F = 2, 2 E = 3 F";
    double volume = 0;
    for (const auto& p : mesh.points) EXPECT_NEAR(p.norm(), 1, 1e-15);
    for (const auto& [i, j, k] : mesh.triangles) {
      const auto at = [&](int n) { return mesh.points[static_cast<std::size_t>(n)]; };
      const double part = at(i).dot(at(j).cross(at(k))) / 6;
      EXPECT_GT(part, 0) << "counter-clockwise from outside";
      volume += part;
    }
    const double sphere = 4.18879020478639, inside = std::pow(inner_radius(mesh), 3) * sphere;
    EXPECT_LT(volume, sphere);
    EXPECT_GT(volume, inside) << "of the sphere that touches faces from inside";
  }
}

TEST(RoundMesh, KnowsItsInnerRadius) {
  // Of an icosahedron: phi^2 / (sqrt(3) sqrt(phi + 2)).
  EXPECT_NEAR(inner_radius(sphere_mesh(20)), 0.7946544722917661, 1e-15);
  EXPECT_GT(inner_radius(sphere_mesh(320)), 0.98);
}

}  // namespace
}  // namespace boxstream::report::narrow
