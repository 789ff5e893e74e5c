// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/boxes.hpp"
#include "mesh/point_triangle.hpp"

namespace boxstream::mesh {

/// How far a point is from a surface. Of several triangles that are equally near, any one may be named.
struct Nearest {
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  double squared = std::numeric_limits<double>::infinity();  ///< the distance, squared
  std::uint32_t triangle = none;
};

/// Do two methods to find a distance agree? Which of two triangles that share the nearest point comes first can change
/// the last digits. `size`: of the surface, as its longest edge.
inline bool same_within_rounding(double squared_a, double squared_b, double size) {
  const double a = std::sqrt(squared_a), b = std::sqrt(squared_b);
  return std::abs(a - b) <= 32 * 0x1p-53 * (a + size);
}

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
