// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "import/convex_hull.hpp"
#include "import/mesh.hpp"

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

/// The mesh cut, by planes across the axes, into parts whose convex hulls stand in for it. Cuts go where they take away
/// most of what the hulls have too much, until the error is small enough, `max_hulls` are reached, or no cut helps; for
/// a mesh that is not closed, until no cut takes away more than max_error of the hulls' volume.
///
/// Hulls do not overlap, and every vertex of the mesh lies in one of them, up to what convex_hull() says. Inside, small
/// corners where three cuts meet may be in none. Deterministic.
///
/// Throws std::runtime_error for a flat mesh and for one of more than most_triangles.
ConvexParts convex_parts(const TriangleMesh& mesh, const PartsOptions& options);

inline constexpr std::size_t most_triangles = 20'000;

}  // namespace boxstream::imports
