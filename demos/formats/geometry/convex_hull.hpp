// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "formats/geometry/solid.hpp"

namespace boxstream::geometry {

struct Hull {
  std::vector<Vec3> points;  // corners, some of the points it was made of
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double volume = 0;
  Vec3 centroid{};
};

/// The hull with all faces moved inwards by `depth`. None if that leaves nothing.
std::optional<Hull> shrunk(const Hull& hull, double depth);

/// What the hull encloses.
Solid solid_of(const Hull& hull);

/// Scenes hold no hull with more corners.
inline constexpr std::size_t most_hull_points = 1000;

/// The convex hull, but for points that stick out of it by less than about a ten-thousandth of its extent (Bullet's
/// btConvexHullComputer works on a lattice). None if all points lie in one plane, or nearly so.
///
/// With more than most_hull_points corners, it has those that lie farthest out in directions spread evenly over the
/// sphere: it is then smaller than the true one, for a sphere by about half a percent of its volume.
std::optional<Hull> convex_hull(const std::vector<Vec3>& points);

/// The same in a fraction of the time: now and then it lacks corners. Empty if all points lie in one plane.
Hull rough_hull(const std::vector<Vec3>& points);

}  // namespace boxstream::geometry
