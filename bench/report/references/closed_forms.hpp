// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

/// Distances and depths of shapes with closed forms, in long double: finitely many features are compared, nothing is
/// iterated. What narrow phases are measured against.
namespace boxstream::report {

using Real = long double;

/// A box with a margin around it: x -> rotation * x + centre. Without half extents it is a sphere, with the last one
/// alone a capsule along its z axis, without a margin a box.
struct RoundedBox {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  double margin = 0;
};

/// Of the sphere around its centre.
double radius(const RoundedBox& solid);

/// The distance, or minus the depth: the least motion that makes overlapping shapes only touch. `half` may have three
/// lengths above zero, one or none: flat boxes with a margin are left out. The columns of both rotations are taken as
/// they are; how far they are from orthonormal shows in the result.
Real signed_distance(const RoundedBox& a, const RoundedBox& b);

}  // namespace boxstream::report
