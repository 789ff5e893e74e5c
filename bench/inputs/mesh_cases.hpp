// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>

#include "formats/import/mesh.hpp"

namespace boxstream::bench {

/// A surface that may meet itself, or two of which the vertices of one have a distance from the other.
struct MeshCase {
  const char* name;
  const char* description;
  imports::TriangleMesh (*to)(std::size_t triangles);
  imports::TriangleMesh (*from)(std::size_t triangles);  ///< none: self-intersections of `to`
  bool far;                                              ///< compared with the size of triangles
};

Span<const MeshCase> mesh_cases();

}  // namespace boxstream::bench
