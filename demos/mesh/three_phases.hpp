// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include <boxstream/aabb.hpp>

#include "mesh/boxes.hpp"
#include "mesh/nearest_triangles.hpp"

namespace boxstream::mesh {

/// What the three phases took.
struct PhaseCounts {
  std::uint64_t first_pairs = 0;   ///< phase I: points in cubes around triangles
  std::uint64_t second_pairs = 0;  ///< phase II, all rounds
  std::uint64_t third_pairs = 0;   ///< phase III: cubes around points, boxes of triangles
  std::uint64_t late_points = 0;   ///< without an estimate after phase I
  int rounds = 0;                  ///< of phase II
};

/// Calls its last argument with (i, j) for each box i of the first set that touches box j of the second, once.
using BoxSearch = std::function<void(const std::vector<Aabb>&, const std::vector<Aabb>&,
                                     const std::function<void(std::uint32_t, std::uint32_t)>&)>;

/// The distance of each point to a surface, by three searches for pairs of boxes ("Fast software for box
/// intersections", section 8). Phase I: triangles near enough that a cube around them holds the point; the nearest
/// gives an upper bound. Phase II: the same for points that are in no cube, with cubes of twice the side, until each is
/// in one. Phase III: all triangles whose boxes are within that bound.
///
/// The number of pairs grows with the square of (distance / size of a triangle): for surfaces that are close to each
/// other. Memory is O(points + triangles) all the same. Throws std::invalid_argument as check() does, and for a mesh
/// without triangles. `search` finds the pairs of boxes; without it, the Detector does.
std::vector<Nearest> three_phase_distances(const std::vector<Vec3>& points, const TriangleMesh& mesh,
                                           PhaseCounts* counts = nullptr, const BoxSearch& search = {});

/// The same distances, within rounding, without that growth: the phases for points that are near the surface, compared
/// with the size of its triangles, and NearestTriangles for the others.
std::vector<Nearest> surface_distances(const std::vector<Vec3>& points, const TriangleMesh& mesh);

}  // namespace boxstream::mesh
