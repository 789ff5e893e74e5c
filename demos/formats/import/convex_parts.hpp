// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "formats/import/geometry.hpp"
#include "formats/import/mesh.hpp"

namespace boxstream::imports {

struct PartsOptions {
  std::size_t max_hulls = 16;  // 1 to 256
  double max_error = 0.05;     // of the mesh's volume; 0: as near as max_hulls allow
};

struct ConvexParts {
  std::vector<Hull> hulls;

  /// How much larger the hulls are, all together, than what the mesh encloses, as a fraction of that. None for a mesh
  /// that is not closed: it encloses nothing.
  std::optional<double> error;
};

/// The mesh cut, by planes across the axes, into parts whose convex hulls approximate it. The part whose hull exceeds
/// it by most is cut next, where the cut removes most of the excess (in the middle if none does), until the error is
/// small enough, there are `max_hulls`, or no cut helps. Parts of a mesh that is not closed have no volume to compare
/// with: cuts are where they remove most, and end when that is less than max_error of the volume of the mesh's hull.
///
/// Hulls do not overlap, and every vertex of the mesh lies in one of them, up to what convex_hull() says. Inside, small
/// corners where three cuts meet may be in none. Deterministic.
///
/// Throws std::runtime_error for a flat mesh and for one of more than most_triangles.
ConvexParts convex_parts(const TriangleMesh& mesh, const PartsOptions& options);

inline constexpr std::size_t most_triangles = 20'000;

}  // namespace boxstream::imports
