// SPDX-License-Identifier: MIT
#include "downhill.hpp"

#include <algorithm>
#include <cmath>

namespace boxstream::ccd {
namespace {

/// The patch reaches so far to each side, in radians.
constexpr double patch = 0.08;
constexpr int most_steps = 40;
constexpr int most_patches = 6;

/// A place on an arc, and how the width changes there.
struct Place {
  double angle;
  double slope;
  WayAlong way;

  // The width of the one point `way.point` along the arc is c cos + s sin.
  double c() const { return way.width * std::cos(angle) - slope * std::sin(angle); }
  double s() const { return way.width * std::sin(angle) + slope * std::cos(angle); }
};

/// Where the two ends' own points are equally far out.
double meeting(const Place& low, const Place& high) {
  return std::atan(-(low.c() - high.c()) / (low.s() - high.s()));
}

/// Where the slope would vanish if it changed evenly.
double levelling(const Place& low, const Place& high) {
  return (low.angle * high.slope - high.angle * low.slope) / (high.slope - low.slope);
}

/// True if nothing between the two can be lower than the lower one by more than this: neither where it bends upwards
/// all the way nor, as around the farthest point from a corner, downwards.
bool are_close(const Place& low, const Place& high, double enough) {
  const double gap = high.angle - low.angle;
  return std::min(-low.slope, high.slope) * gap + std::abs(low.way.width) * gap * gap <= enough;
}

template <class At>
WayAlong lowest_on_arc(const At& at, double enough) {
  // From the middle down, so that of two low places the nearer one is found.
  const Place middle = at(0), end = at(middle.slope < 0 ? patch : -patch);
  WayAlong best = middle.way.width < end.way.width ? middle.way : end.way;
  if (middle.slope * end.slope >= 0) return best;
  Place low = middle.slope < 0 ? middle : end, high = middle.slope < 0 ? end : middle;
  double tried = 0;
  for (int i = 0; i < most_steps && !are_close(low, high, enough); ++i) {
    const double gap = high.angle - low.angle;
    // A guess at kinks, one at smooth places, and after each a little way across it, so that both ends come nearer.
    if (i % 4 == 0)
      tried = meeting(low, high);
    else if (i % 4 == 2)
      tried = levelling(low, high);
    else
      tried += (tried == low.angle ? 1 : -1) * gap / 32;
    tried = std::clamp(tried, low.angle + gap / 256, high.angle - gap / 256);
    const Place next = at(tried);
    if (next.way.width < best.width) best = next.way;
    (next.slope < 0 ? low : high) = next;
  }
  // The mean of both ends that is as far out whichever way one turns.
  best.point = (high.slope * low.way.point - low.slope * high.way.point) / (high.slope - low.slope);
  return best;
}

/// The shortest way out over the patch around a direction.
WayAlong lowest_on_patch(const Couple& couple, const Vec& centre) {
  const Vec east = centre.unitOrthogonal(), north = centre.cross(east);
  const auto at_longitude = [&](double longitude) {
    const Vec equator = std::cos(longitude) * centre + std::sin(longitude) * east;
    const auto at_latitude = [&](double latitude) {
      const Vec unit = std::cos(latitude) * equator + std::sin(latitude) * north;
      const WayAlong way = way_along(couple, unit);
      return Place{latitude, way.point.dot(std::cos(latitude) * north - std::sin(latitude) * equator), way};
    };
    const WayAlong way = lowest_on_arc(at_latitude, couple.tolerance / 16);
    return Place{longitude, way.point.dot(std::cos(longitude) * east - std::sin(longitude) * centre), way};
  };
  return lowest_on_arc(at_longitude, couple.tolerance / 4);
}

}  // namespace

WayAlong way_along(const Couple& couple, const Vec& unit) {
  const Vec point = couple.a.core_support(unit) - couple.b.core_support(-unit);
  return {unit, unit.dot(point), point};
}

WayAlong downhill(const Couple& couple, const Vec& from) {
  WayAlong best = way_along(couple, from);
  for (int i = 0; i < most_patches; ++i) {
    const WayAlong found = lowest_on_patch(couple, best.unit);
    const double gain = best.width - found.width;
    if (gain > 0) best = found;
    if (!(gain > couple.tolerance / 8)) break;
  }
  return best;
}

}  // namespace boxstream::ccd
