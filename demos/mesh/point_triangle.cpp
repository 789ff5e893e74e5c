// SPDX-License-Identifier: MIT
#include "mesh/point_triangle.hpp"

#include <algorithm>
#include <cmath>

#include "formats/geometry/frame.hpp"

namespace boxstream::mesh {
namespace {

using geometry::cross;
using geometry::dot;
using geometry::minus;
using geometry::times;

double length2(const Vec3& v) {
  return dot(v, v);
}

/// a b - c d to within two units in the last place, even where the products nearly cancel (Kahan).
double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  const double lost = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + lost;
}

/// Of thin triangles the plain cross product is mostly rounding.
Vec3 accurate_cross(const Vec3& a, const Vec3& b) {
  return {difference_of_products(a[1], b[2], a[2], b[1]), difference_of_products(a[2], b[0], a[0], b[2]),
          difference_of_products(a[0], b[1], a[1], b[0])};
}

double squared_to_segment(const Vec3& from, const Vec3& to, const Vec3& p) {
  const Vec3 edge = minus(to, from), w = minus(p, from);
  const double along = dot(edge, w), all = length2(edge);
  if (along <= 0) return length2(w);
  if (along >= all) return length2(minus(p, to));
  return length2(minus(w, times(edge, along / all)));
}

}  // namespace

TriangleDistance::TriangleDistance(const Triangle& t) {
  std::size_t longest = 0;
  length2_ = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double l = length2(minus(t[(i + 1) % 3], t[i]));
    if (l > length2_) length2_ = l, longest = i;
  }
  from_ = t[longest];
  to_ = t[(longest + 1) % 3];
  apex_ = t[(longest + 2) % 3];
  const Vec3 n = accurate_cross(minus(from_, apex_), minus(to_, apex_));
  const double length = std::sqrt(length2(n));
  normal_ = length > 0 ? times(n, 1 / length) : Vec3{};
}

// The nearest point is the foot of the perpendicular, if that is in the triangle, or else on an edge that the foot is
// beyond. Rounding can decide wrongly within rounding of the line through an edge. Where the edge itself is, that makes
// no difference. Beyond its ends it would, at sharp corners, and these are at the ends of the longest edge: hence the
// test along it. And it would with three corners nearly on a line, where the longest edge is near all: hence that one
// always counts.
double TriangleDistance::squared(const Vec3& p, double enough) const {
  const Vec3 w = minus(p, apex_);
  const double height = dot(normal_, w), height2 = height * height;
  if (height2 >= enough) return height2;
  const Vec3 to_from = minus(from_, apex_), to_to = minus(to_, apex_), edge = minus(to_, from_), v = minus(p, from_);
  const double along = dot(edge, v);
  const bool any = normal_ == Vec3{} || along < 0 || along > length2_;
  const bool beyond_from = any || dot(cross(normal_, to_from), w) < 0;
  const bool beyond_to = any || dot(cross(to_to, normal_), w) < 0;
  if (!beyond_from && !beyond_to && dot(cross(normal_, edge), v) >= 0) return height2;
  double least = squared_to_segment(from_, to_, p);
  if (beyond_from) least = std::min(least, squared_to_segment(apex_, from_, p));
  if (beyond_to) least = std::min(least, squared_to_segment(to_, apex_, p));
  return least;
}

}  // namespace boxstream::mesh
