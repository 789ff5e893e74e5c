// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "random_shapes.hpp"

/// Answers from formulas and from trying everything.
namespace boxstream::ccd_test {

/// Distance of two segments; both may be points.
double segment_distance(const Vec& a0, const Vec& a1, const Vec& b0, const Vec& b1);

/// Signed distance of a point to a box, a cylinder or a cone: negative inside, the depth below the surface.
double point_to_box(const Vec& point, const ccd::Box& box, const ccd::Pose& pose);
double point_to_cylinder(const Vec& point, const ccd::Cylinder& cylinder, const ccd::Pose& pose);
double point_to_cone(const Vec& point, const ccd::Cone& cone, const ccd::Pose& pose);

/// How far the shape reaches along a direction of unit length.
double reach(const ccd::Shape& shape, const ccd::Pose& pose, const Vec& unit);

/// How far B must move along `unit` to leave A.
double way_out(const ccd::Shape& a, const ccd::Pose& pose_a, const ccd::Shape& b, const ccd::Pose& pose_b,
               const Vec& unit);

/// The least way out over all directions, for shapes with flat faces (boxes and hulls): over every plane through three
/// points of one, and every pair of lines through two points of each. Negative if they are apart.
double least_way_out(const ccd::Shape& a, const ccd::Pose& pose_a, const ccd::Shape& b, const ccd::Pose& pose_b);

/// The shortest way out that a blind search over directions finds, downhill from many starts.
double searched_way_out(const ccd::Shape& a, const ccd::Pose& pose_a, const ccd::Shape& b, const ccd::Pose& pose_b,
                        RandomShapes& random);

}  // namespace boxstream::ccd_test
