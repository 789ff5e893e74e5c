// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <boxstream/aabb.hpp>
#include <boxstream/ray.hpp>

// For the default floating-point environment.
namespace boxstream::detail {

/// A ray as slabs see it: for each axis, t where the ray crosses a bound = (bound - reach - origin) * inverse.
/// Every step is monotone in the bound, rounding included, so a box that contains another is never missed where the
/// inner one is hit.
template <class S>
struct RaySlabs {
  S origin[3];
  S inverse[3];
  S length;       // at most the largest finite number, so that a crossing at infinity is a miss
  S reach_lo[3];  // the lower bound is taken at lo - reach_lo
  S reach_hi[3];
  bool parallel[3];  // infinite inverse, or one of zero: the axis only says inside or outside
  bool is_long[3];   // distances that overflow may be within the length
  bool is_plain;     // none is, all are numbers, and what is swept is a box
  bool hits_nothing;

  explicit RaySlabs(const BasicRay<S>& ray) {
    constexpr S finite = std::numeric_limits<S>::max();
    length = ray.length < finite ? ray.length : finite;
    hits_nothing = !(ray.length >= 0);
    std::copy_n(ray.origin, 3, origin);
    std::copy_n(ray.inverse_direction, 3, inverse);
    std::copy_n(ray.extent_max, 3, reach_lo);
    std::copy_n(ray.extent_min, 3, reach_hi);
    for (int d = 0; d < 3; ++d) parallel[d] = is_long[d] = false;
    is_plain = is_ordinary();
    if (!is_plain) look_closer();
  }

  /// True for a box that is swept, which seldom goes far.
  bool has_reach() const {
    bool is_point = true;
    for (int d = 0; d < 3; ++d) is_point &= (reach_lo[d] == 0) & (reach_hi[d] == 0);
    return !is_point;
  }

  /// t at a bound on an axis that is long: what overflows on the way is a quarter of itself there.
  S far_crossing(S bound, S reach, int d) const {
    constexpr S most = std::numeric_limits<S>::max();
    const S distance = bound - reach - origin[d];
    const S quarter = bound / 4 - reach / 4 - origin[d] / 4;
    return distance <= most && distance >= -most ? distance * inverse[d] : quarter * (4 * inverse[d]);
  }

 private:
  /// No axis is parallel or long, what is swept is a box, and all are numbers, by sums that are none where something is
  /// not. Most rays are so, and what makes others special takes longer to tell than a few boxes to test.
  bool is_ordinary() const {
    constexpr S quarter = std::numeric_limits<S>::max() / 4, inf = std::numeric_limits<S>::infinity();
    S turns = 0, least = inf, far = 0;
    bool is_box = true;
    for (int d = 0; d < 3; ++d) {
      const S turn = std::abs(inverse[d]);
      turns += turn;
      least = turn < least ? turn : least;
      far += std::abs(origin[d]) + std::abs(reach_lo[d]) + std::abs(reach_hi[d]);
      is_box &= reach_hi[d] <= reach_lo[d];
    }
    // A product that overflows would raise a flag, and to take it back takes longer than all of this.
    return is_box && least > 0 && turns < inf && far <= quarter && length <= quarter * (least < 1 ? least : 1);
  }

  void look_closer() {
    constexpr S finite = std::numeric_limits<S>::max();
    constexpr S inf = std::numeric_limits<S>::infinity();
    for (const S x : inverse) length = x == 0 && length > 0 ? 0 : length;
    for (int d = 0; d < 3; ++d) {
      parallel[d] = inverse[d] == inf || inverse[d] == -inf || inverse[d] == 0;  // the last: it goes nowhere
      const S turns = std::abs(inverse[d]);
      const bool is_point = reach_lo[d] == 0 && reach_hi[d] == 0;
      is_long[d] = length > (is_point ? finite : finite / 4) * turns ||
                   (!is_point && (origin[d] > finite / 4 || origin[d] < -finite / 4));
      const bool is_number = origin[d] == origin[d] && inverse[d] == inverse[d] && reach_lo[d] == reach_lo[d] &&
                             reach_hi[d] == reach_hi[d];
      hits_nothing = hits_nothing || !is_number;
    }
  }
};

}  // namespace boxstream::detail
