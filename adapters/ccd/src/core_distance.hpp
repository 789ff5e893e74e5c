// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "couple.hpp"
#include "simplex.hpp"

namespace boxstream::ccd {

/// The distance of two cores (scaled), between two bounds.
struct CoreDistance {
  bool overlap = false;  ///< they share a point, up to rounding; `upper` and `lower` are zero
  double upper = 0;      ///< distance of `on_a` and `on_b`
  double lower = 0;
  Vec on_a;
  Vec on_b;
  Vec direction;    ///< from A to B, of unit length, where most is between them; zero if they touched at once
  Simplex simplex;  ///< what A - B looks like near the origin
  bool limit = false;
};

/// When to be content before the bounds meet.
struct Goal {
  double enough_apart = std::numeric_limits<double>::infinity();  ///< stop once `lower` is above this
  double close_enough = -1;                                       ///< stop once `upper` is not above this
};

/// Gilbert, Johnson and Keerthi's algorithm, until the bounds are within the couple's tolerance, or numbers end, or the
/// iterations.
CoreDistance core_distance(const Couple& couple, int max_iterations, const Goal& goal = {});

}  // namespace boxstream::ccd
