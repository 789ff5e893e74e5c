// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "placed_shape.hpp"

namespace boxstream::ccd {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Interval {
  double low;
  double high;
};

/// Bound on the relative rounding error of a sum of a few products, a root and a shift.
constexpr double share = 8 * epsilon;

/// The bounds of a shape along one world axis, relative to its own origin, in plain arithmetic. `row` is the axis in
/// the frame of the shape. Its length may differ from one by rounding; what rounds a shape is not scaled by it.
struct Reach {
  const Vec& row;

  Interval operator()(const Box& box) const {
    const double reach = row.cwiseAbs().dot(box.half_extents);
    return {-reach, reach};
  }
  Interval operator()(const Sphere& sphere) const {
    const double reach = sphere.radius * std::max(row.norm(), 1.0);
    return {-reach, reach};
  }
  Interval operator()(const Capsule& capsule) const {
    const double reach = capsule.radius * std::max(row.norm(), 1.0) + std::abs(row.z()) * (capsule.height / 2);
    return {-reach, reach};
  }
  Interval operator()(const Cylinder& cylinder) const {
    const double reach = cylinder.radius * across() + std::abs(row.z()) * (cylinder.height / 2);
    return {-reach, reach};
  }
  Interval operator()(const Cone& cone) const {
    const double apex = row.z() * (cone.height / 2);
    const double rim = cone.radius * across();
    return {std::min(apex, -apex - rim), std::max(apex, -apex + rim)};
  }
  Interval operator()(const ConvexHull& hull) const {
    Interval interval{infinity, -infinity};
    for (const Vec& point : hull.points) {
      const double reach = row.dot(point);
      interval.low = std::min(interval.low, reach);
      interval.high = std::max(interval.high, reach);
    }
    return interval;
  }

 private:
  double across() const { return std::sqrt(row.x() * row.x() + row.y() * row.y()); }
};

/// Bound on the rounding error of the above: cancellation in a hull or a cone is measured by the terms, not their sum.
struct Terms {
  const Vec& row;

  double operator()(const ConvexHull& hull) const {
    double most = 0;
    for (const Vec& point : hull.points) most = std::max(most, row.cwiseAbs().dot(point.cwiseAbs()));
    return most;
  }
  double operator()(const Cone& cone) const { return std::abs(row.z()) * (cone.height / 2) + cone.radius * row.norm(); }
  template <class Symmetric>
  double operator()(const Symmetric& shape) const {
    return Reach{row}(shape).high;
  }
};

}  // namespace

Aabb64 bounds(const Shape& shape, const Pose& pose) {
  Aabb64 box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  if (!ball_of(shape) || !is_valid(pose)) return box;
  for (int d = 0; d < 3; ++d) {
    const Vec row = pose.rotation.row(d);
    const Interval reach = std::visit(Reach{row}, shape);
    const double error = share * std::visit(Terms{row}, shape);
    // Each of the two additions may round inwards by half a unit of its result.
    box.min[d] = std::nextafter(std::nextafter(reach.low - error, -infinity) + pose.translation[d], -infinity);
    box.max[d] = std::nextafter(std::nextafter(reach.high + error, infinity) + pose.translation[d], infinity);
  }
  return box;
}

}  // namespace boxstream::ccd
