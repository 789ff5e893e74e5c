// SPDX-License-Identifier: MIT
#pragma once

#include "formats/import/mesh.hpp"

/// Closed surfaces of triangles. Coordinates are floats, so that files hold them exactly. Throw std::invalid_argument
/// for numbers of cells that are too small.
namespace boxstream::mesh {

using imports::TriangleMesh;

/// An immersion of the Klein bottle, the bottle: a tube of n rings with m vertices each (n >= 8, m >= 4 and even), 2 n
/// m triangles. It meets itself along one closed curve, where the neck goes through the wall; see klein_crossing().
TriangleMesh klein_bottle(std::size_t n, std::size_t m);

/// Points of the curve where the bottle goes through itself, `count` on each of its two halves.
std::vector<scenes::Vec3> klein_crossing(std::size_t count);

/// Of radius 1, between two poles: n - 1 circles of latitude with m vertices each (n >= 2, m >= 3).
TriangleMesh sphere(std::size_t n, std::size_t m, double radius = 1);

/// Around the y axis: n rings of radius `tube`, with m vertices each, whose centres are at distance 1 (n, m >= 3).
TriangleMesh torus(std::size_t n, std::size_t m, double tube = 0.4);

}  // namespace boxstream::mesh
