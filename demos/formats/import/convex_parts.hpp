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

/// The mesh cut, by planes across the axes, into parts whose convex hulls stand in for it. The part whose hull has most
/// too much is cut next, where that takes away most (in the middle if nothing does), until the error is small enough,
/// there are `max_hulls`, or nothing is left to gain. In a mesh that is not closed parts have no volume to compare
/// with: there, cuts go where they take away most, and end when that is less than max_error of the volume of its hull.
///
/// Hulls do not overlap, and every vertex of the mesh lies in one of them, up to what convex_hull() says. Inside, small
/// corners where three cuts meet may be in none. Deterministic.
///
/// Throws std::runtime_error for a flat mesh and for one of more than most_triangles.
ConvexParts convex_parts(const TriangleMesh& mesh, const PartsOptions& options);

inline constexpr std::size_t most_triangles = 20'000;

}  // namespace boxstream::imports
