// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "truth.hpp"

namespace boxstream::poses {

using Vec = Eigen::Matrix<Real, 3, 1>;

struct Disc {
  Vec centre, axis;
  Real radius;
};

/// The hull of points and discs, with a margin around; or all below a plane.
struct Body {
  std::vector<Vec> points;
  std::vector<Disc> discs;
  Real margin = 0;
  std::vector<Vec> normals;
  std::vector<std::pair<Vec, Vec>> edges;   // a point and a direction
  std::vector<std::pair<Vec, Real>> rings;  // normals of round sides: an axis, and how far they are along it
  bool below_plane = false;

  /// How far it reaches along a direction of unit length.
  Real reach(const Vec& unit) const;
};

/// A convex solid, in the world's directions, around `origin`.
Body body_of(const Solid& solid, const Eigen::Vector3d& origin);

}  // namespace boxstream::poses
