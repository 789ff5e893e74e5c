// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include "formats/geometry/frame.hpp"

namespace boxstream::scenes {

using geometry::cross, geometry::dot, geometry::minus, geometry::plus;

inline double length(const Vec3& v) {
  return std::sqrt(dot(v, v));
}

/// Corners of something flat, in order; two are a segment, one is a point.
struct Flat {
  static constexpr std::size_t most = 32;

  void add(const Vec3& corner) {
    if (count < most) corners[count++] = corner;
  }
  bool is_face() const { return count > 2; }

  std::array<Vec3, most> corners;
  std::size_t count = 0;
  Vec3 normal{};  // of a face, outwards, of length 1
};

/// One of Bullet's convex shapes where it is, in doubles and without its margin: balls are points and capsules are
/// segments with a radius; so are shapes that are rounded. Places are relative to an origin that both shapes of a pair
/// share, for a float has few digits far away.
class PlacedConvex {
 public:
  PlacedConvex(const btConvexShape& shape, const btTransform& place, const btVector3& origin);

  /// The point that lies farthest in a direction.
  Vec3 support(const Vec3& direction) const;

  /// What of the surface faces a direction most: a face where there is one, else a segment of the surface, else a
  /// point. It contains `support(direction)`.
  Flat facing(const Vec3& direction) const;

  double radius() const { return radius_; }  ///< of the rounding that goes around it
  double size() const { return size_; }      ///< about half its largest extent

 private:
  enum class Kind { point, segment, box, cylinder, cone, hull, triangle, other };

  Vec3 local(const Vec3& direction) const;
  Vec3 world(const Vec3& point) const;
  Vec3 turned(const Vec3& direction) const;
  Vec3 local_support(const Vec3& direction) const;
  void add_disk(double height, const Vec3& direction, Flat& flat) const;
  Flat local_facing(const Vec3& direction) const;
  Flat hull_facing(const Vec3& direction) const;

  const btConvexShape& shape_;
  Kind kind_ = Kind::other;
  std::array<Vec3, 3> rows_{};
  Vec3 at_{};
  Vec3 half_{};                // extents of a box; radius and half height of round shapes, along y
  double low_ = 0, high_ = 0;  // of a cone
  double radius_ = 0, size_ = 0;
};

}  // namespace boxstream::scenes
