// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "pictures/viewer/model.hpp"

namespace boxstream::view {

/// Triangles to draw, counter-clockwise from outside.
struct Surface {
  std::vector<Point> positions;
  std::vector<Point> normals;  ///< unit length, one for each position
  std::vector<std::uint32_t> indices;
};

/// Of a form at unit size: edges sharp where the form has them. A plane is a square from -1 to 1.
Surface surface_of(const Form& form);

/// A surface without edges; normals are the means of the triangles around each vertex.
Surface smooth_surface(const Point* positions, std::size_t count, const std::vector<Triangle>& triangles);

}  // namespace boxstream::view
