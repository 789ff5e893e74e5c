// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <boxstream/span.hpp>

/// Solids as triangles to draw. Round ones lie along y and are made of `segments` around it.
namespace boxstream::solids {

using Point = std::array<float, 3>;
using Triangle = std::array<std::uint32_t, 3>;

/// Triangles, counter-clockwise from outside.
struct Surface {
  std::vector<Point> positions;
  std::vector<Point> normals;  ///< unit length, one for each position
  std::vector<std::uint32_t> indices;
};

// Edges are sharp where the solid has them.

Surface box(const Point& half_extents);
Surface cylinder(float radius, float half_length, int segments);
/// The tip is at y = half_length.
Surface cone(float radius, float half_length, int segments);
/// Half balls whose centres are `half_length` above and below the origin.
Surface capsule(float radius, float half_length, int segments);
/// From -half to half in x and z, at y = 0.
Surface square(float half);

/// Each triangle with its own normal.
Surface flat(Span<const Point> vertices, Span<const Triangle> triangles);
/// Without edges: normals are the means of the triangles around each vertex, weighted by area.
Surface smooth(Span<const Point> vertices, Span<const Triangle> triangles);

}  // namespace boxstream::solids
