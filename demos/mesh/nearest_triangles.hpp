// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "mesh/boxes.hpp"
#include "mesh/nearest.hpp"
#include "mesh/point_triangle.hpp"

namespace boxstream::mesh {

/// The triangles of a mesh in a tree of boxes, for queries of the one nearest to a point: what the three phases are
/// not made for, surfaces that are far apart. Distances are the same within rounding.
///
/// It takes O(n log n) time and O(n) memory to make. Threads: nearest() may run on several at a time. Throws
/// std::invalid_argument as check() does, and for a mesh without triangles.
class NearestTriangles {
 public:
  explicit NearestTriangles(const TriangleMesh& mesh);

  /// `hint`: a triangle that may be near, as that of a point nearby; Nearest::none if none is known.
  Nearest nearest(const Vec3& point, std::uint32_t hint = Nearest::none) const;

  /// Of all points, each with the triangle of the one before as a hint.
  std::vector<Nearest> nearest(const std::vector<Vec3>& points) const;

 private:
  /// The first child of an inner node comes right after it.
  struct Node {
    Aabb box;
    std::uint32_t second_child = 0;  ///< of an inner node
    std::uint32_t first = 0;         ///< place of the first triangle, of a leaf
    std::uint32_t count = 0;         ///< of triangles; 0: an inner node
  };
  struct Item {
    Aabb box;
    std::array<float, 3> centre;
    std::uint32_t number;
  };
  void build(std::vector<Item>& items, std::size_t first, std::size_t count);

  std::vector<Node> nodes_;
  std::vector<TriangleDistance> triangles_;  ///< in the order of leaves
  std::vector<std::uint32_t> numbers_;       ///< in the mesh, of each place
  std::vector<std::uint32_t> places_;        ///< of each number
};

}  // namespace boxstream::mesh
