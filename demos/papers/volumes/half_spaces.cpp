// SPDX-License-Identifier: MIT
#include "papers/volumes/half_spaces.hpp"

#include <Eigen/Geometry>

#include <vector>

namespace boxstream::papers::volumes {

namespace {

using Polygon = std::vector<Point>;

/// The part of a convex polygon in the half-space.
Polygon cut(const Polygon& polygon, const HalfSpace& half_space) {
  Polygon left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double a = half_space.normal.dot(from) - half_space.offset, b = half_space.normal.dot(to) - half_space.offset;
    if (a <= 0) left.push_back(from);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) left.push_back(from + (to - from) * (a / (a - b)));
  }
  return left;
}

double area_of(const Polygon& polygon) {
  Point twice = Point::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return twice.norm() / 2;
}

}  // namespace

Size size_of(Span<const HalfSpace> half_spaces, const Point& near, double radius) {
  Size size{0, 0};
  for (std::size_t i = 0; i < half_spaces.size(); ++i) {
    const Point normal = half_spaces[i].normal.normalized();
    const double height = half_spaces[i].offset / half_spaces[i].normal.norm() - normal.dot(near);
    const Point middle = near + height * normal;
    const Point u = normal.unitOrthogonal() * (2 * radius), v = normal.cross(u);
    Polygon face{middle - u - v, middle + u - v, middle + u + v, middle - u + v};
    for (std::size_t j = 0; j < half_spaces.size(); ++j)
      if (j != i) face = cut(face, half_spaces[j]);
    const double area = area_of(face);
    size.area += area;
    size.volume += area * height / 3;  // of the cone from `near`; below 0 where it is outside
  }
  return size;
}

}  // namespace boxstream::papers::volumes
