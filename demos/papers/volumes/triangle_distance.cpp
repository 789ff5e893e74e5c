// SPDX-License-Identifier: MIT
#include "papers/volumes/triangle_distance.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace boxstream::papers::volumes {

namespace {

double distance_to_segment(const Point& a, const Point& b, const Point& p) {
  const Point way = b - a;
  const double square = way.squaredNorm();
  const double at = square > 0 ? std::clamp(way.dot(p - a) / square, 0.0, 1.0) : 0;
  return (a + at * way - p).norm();
}

}  // namespace

double distance_to_triangle(Points corners, const Point& p) {
  const Point normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  double nearest = std::numeric_limits<double>::infinity();
  bool above = normal.squaredNorm() > 0;  // within the prism over the triangle
  for (std::size_t i = 0; i < 3; ++i) {
    const Point &a = corners[i], &b = corners[(i + 1) % 3];
    if (normal.cross(b - a).dot(p - a) < 0) above = false;
    nearest = std::min(nearest, distance_to_segment(a, b, p));
  }
  return above ? std::abs(normal.normalized().dot(p - corners[0])) : nearest;
}

}  // namespace boxstream::papers::volumes
