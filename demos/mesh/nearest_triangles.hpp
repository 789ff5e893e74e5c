// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <boxstream/world.hpp>

#include "mesh/boxes.hpp"
#include "mesh/nearest.hpp"
#include "mesh/point_triangle.hpp"

namespace boxstream::mesh {

/// The triangles of a mesh in a World, to be asked for the one nearest to a point: what the three phases are not made
/// for, surfaces that are far apart. Distances are the same within rounding.
///
/// Threads: nearest() may run on several at a time. Throws std::invalid_argument as check() does, and for a mesh
/// without triangles.
class NearestTriangles {
 public:
  explicit NearestTriangles(const TriangleMesh& mesh);

  /// `hint`: a triangle that may be near, as that of a point nearby; Nearest::none if none is known.
  Nearest nearest(const Vec3& point, std::uint32_t hint = Nearest::none) const;

  /// Of all points, each with the triangle of the one before as a hint.
  std::vector<Nearest> nearest(const std::vector<Vec3>& points) const;

 private:
  std::vector<TriangleDistance> triangles_;
  World world_;
};

}  // namespace boxstream::mesh
