// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <boxstream/aabb.hpp>

#include "papers/volumes/point.hpp"

namespace boxstream::papers::volumes {

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

}  // namespace boxstream::papers::volumes
