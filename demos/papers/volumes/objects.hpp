// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <boxstream/aabb.hpp>
#include <cstdint>
#include <vector>

#include "papers/volumes/volume.hpp"

namespace boxstream::papers::volumes {

/// Distance from `p` to the triangle of three corners, which may be on one line or in one point.
double distance_to_triangle(Points corners, const Point& p);

struct Triangle {
  float corners[3][3];
};

std::array<Point, 8> corners_of(const Aabb& box);

/// What hierarchies are built over. An object is known by its number and by its corners: it lies in their convex hull,
/// and so in every convex volume that has them.
///
/// All coordinates must be finite and boxes valid; std::invalid_argument names the first object that is not.
class Objects {
 public:
  static Objects of(Span<const Aabb> boxes);
  static Objects of(Span<const Triangle> triangles);

  std::size_t size() const { return starts_.size() - 1; }
  Points corners(std::uint32_t object) const {
    return {points_.data() + starts_[object], starts_[object + 1] - starts_[object]};
  }

 private:
  void close_object();

  std::vector<Point> points_;
  std::vector<std::size_t> starts_{0};
};

/// Objects as builders see them: their boxes and the centres of these. Volumes come afterwards, around the corners.
struct Atoms {
  explicit Atoms(const Objects& objects);

  std::vector<Aabb64> boxes;
  std::vector<Point> centres;
};

/// A surface of `columns` x `rows` fields of two triangles each. `corner(column, row, out)` says where a corner is;
/// there is one more of these than of fields each way.
template <class Corner>
std::vector<Triangle> triangulated_fields(int columns, int rows, const Corner& corner) {
  std::vector<Triangle> triangles;
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < rows; ++row) {
      Triangle low{}, high{};
      corner(column, row, low.corners[0]);
      corner(column + 1, row, low.corners[1]);
      corner(column, row + 1, low.corners[2]);
      corner(column + 1, row, high.corners[0]);
      corner(column + 1, row + 1, high.corners[1]);
      corner(column, row + 1, high.corners[2]);
      triangles.push_back(low);
      triangles.push_back(high);
    }
  return triangles;
}

}  // namespace boxstream::papers::volumes
