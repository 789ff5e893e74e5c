// SPDX-License-Identifier: MIT
#include "simulation/engine/contacts/placed_convex.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <btBulletCollisionCommon.h>

#include "simulation/engine/cone.hpp"
#include "simulation/engine/contacts/hull_shape.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {
namespace {

/// How many corners stand for a disk. Bullet keeps four contact points.
constexpr int disk_corners = 12;

}  // namespace

PlacedConvex::PlacedConvex(const btConvexShape& shape, const btTransform& place, const btVector3& origin)
    : shape_(shape), at_(minus(exact(place.getOrigin()), exact(origin))) {
  for (int row = 0; row < 3; ++row) rows_[static_cast<std::size_t>(row)] = exact(place.getBasis()[row]);
  switch (shape.getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE:
      kind_ = Kind::point;
      radius_ = double{static_cast<const btSphereShape&>(shape).getRadius()};
      size_ = radius_;
      break;
    case CAPSULE_SHAPE_PROXYTYPE: {
      const auto& capsule = static_cast<const btCapsuleShape&>(shape);
      if (capsule.getUpAxis() != 1) break;
      kind_ = Kind::segment;
      half_ = {0, double{capsule.getHalfHeight()}, 0};
      radius_ = double{capsule.getRadius()};
      size_ = half_[1] + radius_;
      break;
    }
    case BOX_SHAPE_PROXYTYPE:
      kind_ = Kind::box;
      half_ = exact(static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin());
      size_ = std::max({half_[0], half_[1], half_[2]});
      break;
    case CYLINDER_SHAPE_PROXYTYPE: {
      const auto& cylinder = static_cast<const btCylinderShape&>(shape);
      if (cylinder.getUpAxis() != 1) break;
      kind_ = Kind::cylinder;
      half_ = exact(cylinder.getHalfExtentsWithMargin());
      size_ = std::max(half_[0], half_[1]);
      break;
    }
    case CONVEX_HULL_SHAPE_PROXYTYPE:
      if (dynamic_cast<const HullOfFaces*>(&shape) == nullptr) break;
      kind_ = Kind::hull;
      radius_ = double{shape.getMargin()};
      break;
    case TRIANGLE_SHAPE_PROXYTYPE:
      kind_ = Kind::triangle;
      radius_ = double{shape.getMargin()};
      break;
    case CUSTOM_CONVEX_SHAPE_TYPE:
      if (const auto* const cone = dynamic_cast<const Cone*>(&shape)) {
        kind_ = Kind::cone;
        half_ = {double{cone->radius()}, 0, 0};
        low_ = double{cone->base()}, high_ = double{cone->apex()};
        radius_ = double{shape.getMargin()};
        size_ = std::max(half_[0], (high_ - low_) / 2);
      }
      break;
    default:
      break;
  }
  if (kind_ == Kind::other) radius_ = double{shape.getMargin()};
  if (size_ == 0) {
    btVector3 low, high;
    shape.getAabb(btTransform::getIdentity(), low, high);
    const btVector3 half = (high - low) / 2;
    size_ = double{half[half.maxAxis()]};
  }
}

Vec3 PlacedConvex::local(const Vec3& d) const {
  return plus(plus(times(rows_[0], d[0]), times(rows_[1], d[1])), times(rows_[2], d[2]));
}

Vec3 PlacedConvex::turned(const Vec3& d) const {
  return {dot(rows_[0], d), dot(rows_[1], d), dot(rows_[2], d)};
}

Vec3 PlacedConvex::world(const Vec3& point) const {
  return plus(at_, turned(point));
}

Vec3 PlacedConvex::local_support(const Vec3& d) const {
  const auto with_sign = [](double size, double sign) { return sign < 0 ? -size : size; };
  switch (kind_) {
    case Kind::point:
      return {};
    case Kind::segment:
      return {0, with_sign(half_[1], d[1]), 0};
    case Kind::box:
      return {with_sign(half_[0], d[0]), with_sign(half_[1], d[1]), with_sign(half_[2], d[2])};
    case Kind::cylinder: {
      const double across = std::hypot(d[0], d[2]), share = across > 0 ? half_[0] / across : 0;
      return {d[0] * share, with_sign(half_[1], d[1]), d[2] * share};
    }
    case Kind::cone: {
      const double across = std::hypot(d[0], d[2]);
      if (d[1] * (high_ - low_) > across * half_[0]) return {0, high_, 0};
      const double share = across > 0 ? half_[0] / across : 0;
      return {d[0] * share, low_, d[2] * share};
    }
    case Kind::hull: {
      const auto& hull = static_cast<const btConvexHullShape&>(shape_);
      const btVector3* const points = hull.getUnscaledPoints();
      const int count = hull.getNumPoints();
      int best = 0;
      double most = dot(exact(points[0]), d);
      for (int i = 1; i < count; ++i)
        if (const double far = dot(exact(points[i]), d); far > most) most = far, best = i;
      return exact(points[best]);
    }
    case Kind::triangle: {
      const auto& corners = static_cast<const btTriangleShape&>(shape_).m_vertices1;
      int best = 0;
      double most = dot(exact(corners[0]), d);
      for (int i = 1; i < 3; ++i)
        if (const double far = dot(exact(corners[i]), d); far > most) most = far, best = i;
      return exact(corners[best]);
    }
    case Kind::other:
      return exact(shape_.localGetSupportingVertexWithoutMargin(vector(d)));
  }
  return {};
}

Vec3 PlacedConvex::support(const Vec3& direction) const {
  return world(local_support(local(direction)));
}

/// The first corner is the one that lies farthest in the direction.
void PlacedConvex::add_disk(double height, const Vec3& d, Flat& flat) const {
  const double across = std::hypot(d[0], d[2]);
  const double first = across > 0 ? std::atan2(d[2], d[0]) : 0;
  for (int i = 0; i < disk_corners; ++i) {
    const double angle = first + 2 * std::numbers::pi * i / disk_corners;
    flat.add({half_[0] * std::cos(angle), height, half_[0] * std::sin(angle)});
  }
}

Flat PlacedConvex::hull_facing(const Vec3& d) const {
  const auto& hull = static_cast<const HullOfFaces&>(shape_);
  const HullOfFaces::Face* best = nullptr;
  double most = -2 * length(d);
  for (const HullOfFaces::Face& face : hull.faces())
    if (const double along = dot(face.normal, d); along > most) most = along, best = &face;
  Flat flat;
  if (best == nullptr) {
    flat.add(local_support(d));
    return flat;
  }
  flat.normal = best->normal;
  const std::size_t step = (best->corners.size() + Flat::most - 1) / Flat::most;
  for (std::size_t i = 0; i < best->corners.size(); i += step)
    flat.add(exact(hull.getUnscaledPoints()[best->corners[i]]));
  return flat;
}

Flat PlacedConvex::local_facing(const Vec3& d) const {
  Flat flat;
  switch (kind_) {
    case Kind::segment:
      flat.add({0, -half_[1], 0});
      flat.add({0, half_[1], 0});
      return flat;
    case Kind::box: {
      std::size_t axis = 0;
      for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(d[i]) > std::abs(d[axis])) axis = i;
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      const double sign = d[axis] < 0 ? -1 : 1;
      flat.normal[axis] = sign;
      for (const auto& [a, b] : {std::array{1.0, 1.0}, {-1.0, 1.0}, {-1.0, -1.0}, {1.0, -1.0}}) {
        Vec3 corner{};
        corner[axis] = sign * half_[axis], corner[u] = a * half_[u], corner[v] = b * half_[v];
        flat.add(corner);
      }
      return flat;
    }
    case Kind::cylinder: {
      const double across = std::hypot(d[0], d[2]);
      if (std::abs(d[1]) > across) {
        const double sign = d[1] < 0 ? -1 : 1;
        flat.normal = {0, sign, 0};
        add_disk(sign * half_[1], d, flat);
      } else {
        const double x = d[0] / across * half_[0], z = d[2] / across * half_[0];
        flat.add({x, -half_[1], z});
        flat.add({x, half_[1], z});
      }
      return flat;
    }
    case Kind::cone: {
      const double across = std::hypot(d[0], d[2]), height = high_ - low_, slant = std::hypot(height, half_[0]);
      const double down = -d[1], aside = (across * height + d[1] * half_[0]) / slant;
      if (down >= aside || !(across > 0)) {
        if (d[1] > 0) {
          flat.add({0, high_, 0});
        } else {
          flat.normal = {0, -1, 0};
          add_disk(low_, d, flat);
        }
      } else {
        flat.add({d[0] / across * half_[0], low_, d[2] / across * half_[0]});
        flat.add({0, high_, 0});
      }
      return flat;
    }
    case Kind::hull:
      return hull_facing(d);
    case Kind::triangle: {
      const auto& corners = static_cast<const btTriangleShape&>(shape_).m_vertices1;
      for (int i = 0; i < 3; ++i) flat.add(exact(corners[i]));
      const Vec3 n = cross(minus(flat.corners[1], flat.corners[0]), minus(flat.corners[2], flat.corners[0]));
      const double area = length(n);
      if (area > 0) flat.normal = times(n, (dot(n, d) < 0 ? -1 : 1) / area);
      return flat;
    }
    case Kind::point:
    case Kind::other:
      flat.add(local_support(d));
      return flat;
  }
  return flat;
}

Flat PlacedConvex::facing(const Vec3& direction) const {
  Flat flat = local_facing(local(direction));
  for (std::size_t i = 0; i < flat.count; ++i) flat.corners[i] = world(flat.corners[i]);
  flat.normal = turned(flat.normal);
  return flat;
}

}  // namespace boxstream::scenes
