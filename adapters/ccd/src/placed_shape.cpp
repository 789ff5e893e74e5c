// SPDX-License-Identifier: MIT
#include "placed_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boxstream::ccd {
namespace {

double with_sign(double size, double direction) {
  return direction < 0 ? -size : size;
}

/// The point of a circle around z that is farthest along `direction`; its centre when no point is farther than another.
Vec on_circle(double radius, double z, const Vec& direction) {
  const double length = std::hypot(direction.x(), direction.y());
  if (!(length > 0)) return {0, 0, z};
  return {radius * (direction.x() / length), radius * (direction.y() / length), z};
}

struct CoreSupport {
  const Vec& direction;

  Vec operator()(const Box& box) const {
    return {with_sign(box.half_extents.x(), direction.x()), with_sign(box.half_extents.y(), direction.y()),
            with_sign(box.half_extents.z(), direction.z())};
  }
  Vec operator()(const Sphere&) const { return Vec::Zero(); }
  Vec operator()(const Capsule& capsule) const { return {0, 0, with_sign(capsule.height / 2, direction.z())}; }
  Vec operator()(const Cylinder& cylinder) const {
    return on_circle(cylinder.radius, with_sign(cylinder.height / 2, direction.z()), direction);
  }
  Vec operator()(const Cone& cone) const {
    const Vec apex(0, 0, cone.height / 2);
    const Vec rim = on_circle(cone.radius, -cone.height / 2, direction);
    return direction.dot(apex) > direction.dot(rim) ? apex : rim;
  }
  Vec operator()(const ConvexHull& hull) const {
    const Vec* best = hull.points.data();
    double most = direction.dot(*best);
    for (const Vec& point : hull.points)
      if (const double reach = direction.dot(point); reach > most) most = reach, best = &point;
    return *best;
  }
};

bool is_size(double size) {
  return size >= 0 && std::isfinite(size);
}

/// Around the local origin, if these sizes are legal.
std::optional<Ball> centred(double size, double other_size, double radius) {
  if (!is_size(size) || !is_size(other_size) || !std::isfinite(radius)) return std::nullopt;
  return Ball{Vec::Zero(), radius};
}

struct BallOf {
  std::optional<Ball> operator()(const Box& box) const {
    if (!is_size(box.half_extents.z())) return std::nullopt;
    return centred(box.half_extents.x(), box.half_extents.y(), box.half_extents.stableNorm());
  }
  std::optional<Ball> operator()(const Sphere& sphere) const { return centred(sphere.radius, 0, sphere.radius); }
  std::optional<Ball> operator()(const Capsule& capsule) const {
    return centred(capsule.radius, capsule.height, capsule.radius + capsule.height / 2);
  }
  std::optional<Ball> operator()(const Cylinder& cylinder) const {
    return centred(cylinder.radius, cylinder.height, std::hypot(cylinder.radius, cylinder.height / 2));
  }
  std::optional<Ball> operator()(const Cone& cone) const {
    return centred(cone.radius, cone.height, std::hypot(cone.radius, cone.height / 2));
  }
  std::optional<Ball> operator()(const ConvexHull& hull) const {
    if (hull.points.empty()) return std::nullopt;
    Vec low = hull.points.front(), high = low;
    bool finite = true;
    for (const Vec& point : hull.points)
      low = low.cwiseMin(point), high = high.cwiseMax(point), finite = finite && point.allFinite();
    if (!finite || !std::isfinite(low.stableNorm() + high.stableNorm())) return std::nullopt;
    const Vec centre = low / 2 + high / 2, half = high / 2 - low / 2;
    const double unit = half.maxCoeff();
    if (!(unit > std::numeric_limits<double>::min())) return Ball{centre, half.stableNorm()};
    double most = 0;
    for (const Vec& point : hull.points) most = std::max(most, ((point - centre) * (1 / unit)).squaredNorm());
    return Ball{centre, unit * std::sqrt(most)};
  }
};

/// The mean of a hull's points, the middle of anything else.
Vec local_inside(const Shape& shape) {
  const auto* const hull = std::get_if<ConvexHull>(&shape);
  if (!hull) return Vec::Zero();
  Vec sum = Vec::Zero();
  for (const Vec& point : hull->points) sum += point;
  return sum / static_cast<double>(hull->points.size());
}

}  // namespace

Vec local_core_support(const Shape& shape, const Vec& direction) {
  return std::visit(CoreSupport{direction}, shape);
}

double rounding_of(const Shape& shape) {
  if (const auto* const sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
  if (const auto* const capsule = std::get_if<Capsule>(&shape)) return capsule->radius;
  return 0;
}

Vec PlacedShape::core_support(const Vec& direction) const {
  return place(local_core_support(*shape_, rotation_->transpose() * direction));
}

Vec PlacedShape::support(const Vec& direction) const {
  const Vec core = core_support(direction);
  const double radius = rounding();
  return radius > 0 ? Vec(core + direction.stableNormalized() * radius) : core;
}

double PlacedShape::rounding() const {
  return rounding_of(*shape_) * scale_;
}

Vec PlacedShape::inside() const {
  return place(local_inside(*shape_));
}

std::optional<Ball> ball_of(const Shape& shape) {
  return std::visit(BallOf{}, shape);
}

bool is_valid(const Pose& pose) {
  constexpr double most = 1e-4;
  if (!pose.translation.allFinite() || !pose.rotation.allFinite()) return false;
  const Eigen::Matrix3d error = pose.rotation.transpose() * pose.rotation - Eigen::Matrix3d::Identity();
  return error.cwiseAbs().maxCoeff() <= most && pose.rotation.determinant() > 0;
}

}  // namespace boxstream::ccd
