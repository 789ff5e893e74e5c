// SPDX-License-Identifier: MIT
#pragma once

#include "couple.hpp"

namespace boxstream::ccd {

/// A direction, how far B must move along it to leave A (cores), and a point of A - B that says so: the farthest one
/// along the direction, or a mean of such points.
struct WayAlong {
  Vec unit;
  double width;
  Vec point;
};

WayAlong way_along(const Couple& couple, const Vec& unit);

/// The shortest way out near a direction. Two searches, one inside the other, over latitude and longitude of a small
/// patch: each keeps two places between which the way out gets shorter from either end, so neither minds kinks.
WayAlong downhill(const Couple& couple, const Vec& from);

}  // namespace boxstream::ccd
