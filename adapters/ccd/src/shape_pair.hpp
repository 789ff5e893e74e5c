// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "placed_shape.hpp"

namespace boxstream::ccd {

/// Two shapes in the frame of the solvers. Solvers compare with fixed small numbers, so A's centre is moved to the
/// origin (which keeps precision far from it) and the pair is scaled until the smaller shape has size one.
struct ShapePair {
  PlacedShape a;
  PlacedShape b;
  Vec origin;
  double scale;
  double size;       ///< of the smaller shape, scaled
  double tolerance;  ///< scaled, and not below what doubles resolve
  double noise;      ///< bound on the rounding error of a support point, scaled
  double extent;     ///< largest distance of a point of one from a point of the other, scaled
  double rounding;   ///< of both shapes

  double core_width(const Vec& unit) const { return unit.dot(a.core_support(unit) - b.core_support(-unit)); }
  Vec to_world(const Vec& point) const { return point / scale + origin; }
};

/// Empty for invalid input.
std::optional<ShapePair> make_shape_pair(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                                         const Options& options);

}  // namespace boxstream::ccd
