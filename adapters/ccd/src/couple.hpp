// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "posed.hpp"

namespace boxstream::ccd {

/// Two shapes as the solvers see them. Solvers compare with fixed small numbers, so the pair is moved until A's centre
/// is the origin (which keeps the digits of pairs far out, and of hulls whose points are) and scaled until the smaller
/// shape has size one.
struct Couple {
  Posed a;
  Posed b;
  Vec origin;
  double scale;
  double size;       ///< of the smaller shape, scaled
  double tolerance;  ///< scaled, and not below what doubles resolve
  double noise;      ///< bound on the rounding error of a support point, scaled
  double extent;     ///< no point of one is farther from a point of the other, scaled
  double rounding;   ///< of both shapes

  double core_width(const Vec& unit) const { return unit.dot(a.core_support(unit) - b.core_support(-unit)); }
  Vec to_world(const Vec& point) const { return point / scale + origin; }
};

/// Empty if anything about the input is not valid.
std::optional<Couple> make_couple(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                                  const Options& options);

}  // namespace boxstream::ccd
