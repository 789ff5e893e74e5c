// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <boxstream/pair.hpp>

#include "mesh/boxes.hpp"

namespace boxstream::mesh {

struct SelfIntersections {
  std::vector<Pair> pairs;                  ///< of triangles, in order, the smaller number first
  std::vector<std::uint32_t> without_area;  ///< they are in no pair
  std::uint64_t candidates = 0;             ///< pairs of triangles with area whose boxes touch
};

/// Do two triangles with area intersect, beyond what they share by number? Without a vertex in common: they do if they
/// touch anywhere. With one or two: if they have a point in common that is not that vertex, or not on that edge. With
/// three: they do, one lies on the other.
bool intersect(const TriangleMesh& mesh, std::uint32_t s, std::uint32_t t);

/// Every pair of triangles of a mesh that intersect, exactly: candidates from the Detector, each put to intersect().
/// Vertices are shared by number, so those at the same place have to be welded before. The mesh need be neither closed
/// nor orientable. Memory: O(triangles) and the pairs found. Throws std::invalid_argument as check() does.
///
/// Does not say where triangles intersect, and does not repair anything.
SelfIntersections self_intersections(const TriangleMesh& mesh);

}  // namespace boxstream::mesh
