// SPDX-License-Identifier: MIT
#include "papers/volumes/objects.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "papers/volumes/axis_box.hpp"

namespace boxstream::papers::volumes {

std::array<Point, 8> corners_of(const Aabb& box) {
  std::array<Point, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] =
        Point(i & 1 ? box.max[0] : box.min[0], i & 2 ? box.max[1] : box.min[1], i & 4 ? box.max[2] : box.min[2]);
  return corners;
}

void Objects::close_object() {
  for (std::size_t i = starts_.back(); i < points_.size(); ++i)
    if (!points_[i].allFinite())
      throw std::invalid_argument("object " + std::to_string(size()) + " has a coordinate that is not finite");
  starts_.push_back(points_.size());
}

Objects Objects::of(Span<const Aabb> boxes) {
  Objects objects;
  for (const Aabb& box : boxes) {
    if (!is_valid(box)) throw std::invalid_argument("object " + std::to_string(objects.size()) + " is no valid box");
    for (const Point& corner : corners_of(box)) objects.points_.push_back(corner);
    objects.close_object();
  }
  return objects;
}

Objects Objects::of(Span<const Triangle> triangles) {
  Objects objects;
  for (const Triangle& triangle : triangles) {
    for (const auto& corner : triangle.corners) objects.points_.emplace_back(corner[0], corner[1], corner[2]);
    objects.close_object();
  }
  return objects;
}

Atoms::Atoms(const Objects& objects) {
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    const AxisBox box = AxisBox::around(objects.corners(i));
    boxes.push_back(box.box);
    centres.push_back(box.centre());
  }
}

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
