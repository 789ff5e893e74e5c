// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "shape_pair.hpp"
#include "simplex.hpp"

namespace boxstream::ccd {

/// The distance of two cores (scaled), between two bounds.
struct CoreDistance {
  bool overlap = false;  ///< they share a point, up to rounding; `upper` and `lower` are zero
  double upper = 0;      ///< distance of `on_a` and `on_b`
  double lower = 0;
  Vec on_a;
  Vec on_b;
  Vec direction;    ///< from A to B, unit length, with the largest gap; zero if they overlap at the first point
  Simplex simplex;  ///< the part of A - B next to the origin
  bool limit = false;
};

/// When to stop before the bounds meet.
struct Goal {
  double enough_apart = std::numeric_limits<double>::infinity();  ///< stop once `lower` is above this
  double close_enough = -1;                                       ///< stop once `upper` is not above this
};

/// Gilbert, Johnson and Keerthi's algorithm, until the bounds are within the pair's tolerance, or to the limit of
/// precision or of iterations.
CoreDistance core_distance(const ShapePair& pair, int max_iterations, const Goal& goal = {});

}  // namespace boxstream::ccd
