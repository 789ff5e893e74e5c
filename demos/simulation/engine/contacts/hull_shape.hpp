// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include "formats/geometry/convex_hull.hpp"

namespace boxstream::scenes {

/// Bullet's hull with what it does not know: its faces.
class HullOfFaces final : public btConvexHullShape {
 public:
  struct Face {
    geometry::Vec3 normal;               // outwards, of length 1
    std::vector<std::uint32_t> corners;  // in order
  };

  /// The hull's corners, moved to `points` one by one.
  HullOfFaces(const geometry::Hull& hull, const std::vector<geometry::Vec3>& points);

  const std::vector<Face>& faces() const { return faces_; }

 private:
  std::vector<Face> faces_;
};

}  // namespace boxstream::scenes
