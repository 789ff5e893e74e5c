// SPDX-License-Identifier: MIT
#pragma once

#include "simulation/engine/contacts/placed_convex.hpp"

namespace boxstream::scenes {

/// Up to four points that stand for where two shapes touch, or nearly do: as many as a manifold of Bullet has.
struct ContactPoints {
  struct Point {
    Vec3 on_b;
    double distance;
  };

  std::array<Point, 4> points;
  std::size_t count = 0;
  Vec3 normal{};  // from b to a, of length 1
};

/// Leaves the four of more points that stand for all of them best, `points` being those of one face.
void choose_four(const ContactPoints::Point* points, std::size_t count, ContactPoints& out);

/// All at once, from the faces that look at each other; none where the shapes are farther apart than `reach`.
ContactPoints contact_points(const PlacedConvex& a, const PlacedConvex& b, double reach);

/// Of a shape on the half-space { x : normal . x <= offset }, which is b.
ContactPoints contact_points(const PlacedConvex& a, const Vec3& normal, double offset, double reach);

}  // namespace boxstream::scenes
