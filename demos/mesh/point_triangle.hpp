// SPDX-License-Identifier: MIT
#pragma once

#include "mesh/triangle_triangle.hpp"

namespace boxstream::mesh {

/// A triangle prepared for queries of its distance to many points. It may lack area: a segment or a point.
///
/// The error of a distance is a few units in the last place of the distance plus the longest edge, however thin the
/// triangle is (tested: below 16 x 2^-53 of that sum). Coordinates as in orientation.hpp.
class TriangleDistance {
 public:
  explicit TriangleDistance(const Triangle& t);

  /// The square of the distance between `p` and the closed triangle, or some number that is at least `enough` if the
  /// distance squared is: what is far away need not be known.
  double squared(const Vec3& p, double enough) const;

 private:
  Vec3 apex_, from_, to_;  // the longest edge, and the corner that faces it
  Vec3 normal_;            // of length 1; zero without area
  double length2_;         // of the longest edge, squared
};

}  // namespace boxstream::mesh
