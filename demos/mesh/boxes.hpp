// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/aabb.hpp>

#include "formats/import/mesh.hpp"
#include "mesh/triangle_triangle.hpp"

namespace boxstream::mesh {

using imports::TriangleMesh;

inline Triangle triangle_of(const TriangleMesh& mesh, std::size_t t) {
  const auto& c = mesh.triangles[t];
  return {mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]]};
}

/// The largest float not above `x`, and the smallest not below; infinite where there is none.
float rounded_down(double x);
float rounded_up(double x);

/// The smallest box of floats around the corners of a triangle, and around a point with `reach` on all sides.
Aabb box_of(const Triangle& t);
Aabb box_of(const Vec3& point, double reach = 0);

/// The longest side of the box around each triangle, the longest of all.
double largest_side(const TriangleMesh& mesh);

/// Throws std::invalid_argument for a triangle with a vertex that is not there, and for a coordinate that is neither 0
/// nor of a magnitude between the limits of orientation.hpp.
void check(const TriangleMesh& mesh);
void check(const std::vector<Vec3>& points);

}  // namespace boxstream::mesh
