// SPDX-License-Identifier: MIT
#pragma once

#include "mesh/orientation.hpp"

/// Which triangles have points in common: exact for coordinates as in orientation.hpp, and so the same in any order of
/// triangles and corners. Triangles are closed. Only has_area() takes triangles without area.
namespace boxstream::mesh {

using Triangle = std::array<Vec3, 3>;

/// False if the corners are on a line.
bool has_area(const Triangle& t);

/// Do they share a point? Touching counts.
bool meet(const Triangle& s, const Triangle& t);

/// For triangles with s[0] == t[0]: do they share a point beside that corner?
bool meet_beyond_corner(const Triangle& s, const Triangle& t);

/// For triangles with s[0] == t[0] and s[1] == t[1]: do they share a point beside that edge? That is, does one lie on
/// the other.
bool meet_beyond_edge(const Triangle& s, const Triangle& t);

}  // namespace boxstream::mesh
