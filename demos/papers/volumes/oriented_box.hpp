// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>

#include "papers/volumes/volume.hpp"

namespace boxstream::papers::volumes {

/// An oriented bounding box: { p : |axes[i] (p - centre)| <= half[i] for the three columns of `axes` }, 15 numbers.
/// Along the principal axes of the points it was made around, so it follows them when they turn; or along the
/// coordinate axes where that has less surface: points that vary alike in all directions, as the corners of a cube do,
/// have no principal axes but those that rounding makes.
struct OrientedBox {
  Point centre;
  Eigen::Matrix3d axes;
  Point half;

  static OrientedBox around(Points points);
  /// Around the boxes' corners.
  static OrientedBox around(Span<const OrientedBox> boxes);
  static constexpr bool merges_exactly = false;
  static std::string name() { return "OBB"; }

  /// Their hull contains the box.
  std::array<Point, 8> corners() const;
  double excess(const Point& p) const {
    return ((axes.transpose() * (p - centre)).cwiseAbs() - half).maxCoeff() / (1 + slack);
  }
  Aabb64 bounds() const;
  double volume() const { return 8 * half.prod(); }
  double area() const { return 8 * (half[0] * half[1] + half[1] * half[2] + half[2] * half[0]); }

  /// Looks for a separating line among the 15 that can be one.
  friend bool overlap(const OrientedBox& a, const OrientedBox& b);
};
static_assert(Volume<OrientedBox>);

}  // namespace boxstream::papers::volumes
