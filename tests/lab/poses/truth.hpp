// SPDX-License-Identifier: MIT
#pragma once

#include "hard_pose.hpp"

/// Signed distances from trying directions in long double: no simplex, no polytope that grows, nothing of the solvers.
namespace boxstream::poses {

using Real = long double;

/// How far B is beyond A along a direction (of any length above 0); negative if they overlap along it. Both convex.
Real gap_along(const Solid& a, const Solid& b, const Eigen::Vector3d& direction);

/// The largest gap over all directions: the distance, or minus the depth. Both convex. For shapes of corners, edges and
/// faces (rounded or not) the directions that can be the best are finitely many, and all are tried: exact up to
/// rounding in long double. With circles around, directions everywhere are tried and the best ones refined: never above
/// the truth, and below it by what refining leaves, see truth_test.cpp.
Real signed_distance_of_convex(const Solid& a, const Solid& b);

/// The direction of that gap, for shapes without circles.
Eigen::Vector3d way_apart(const Solid& a, const Solid& b);

/// Of solids made of convex parts: right for those apart or touching.
Real signed_distance(const Solid& a, const Solid& b);

/// True if no circles are around.
bool is_exact(const Solid& a, const Solid& b);

/// The middle of a solid of points, which need not be near their origin; the origin of any other.
Eigen::Vector3d middle_of(const Solid& solid);
/// Of the sphere around the middle of a shape; infinite for a half-space.
double radius(const Solid& solid);
/// Coordinates of both shapes, and between them, are below this.
double extent(const Solid& a, const Solid& b);

}  // namespace boxstream::poses
