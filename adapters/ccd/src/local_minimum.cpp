// SPDX-License-Identifier: MIT
#include "local_minimum.hpp"

#include <algorithm>
#include <cmath>

namespace boxstream::ccd {
namespace {

/// Half the width of a patch, in radians.
constexpr double patch = 0.08;
constexpr int most_steps = 40;
constexpr int most_patches = 6;

/// A position on an arc, and the derivative of the width there.
struct Place {
  double angle;
  double slope;
  Translation translation;

  // The width of the one point `translation.point` along the arc is c cos + s sin.
  double c() const { return translation.width * std::cos(angle) - slope * std::sin(angle); }
  double s() const { return translation.width * std::sin(angle) + slope * std::cos(angle); }
};

/// Where the support points of both ends have equal widths: exact at kinks.
double meeting(const Place& low, const Place& high) {
  return std::atan(-(low.c() - high.c()) / (low.s() - high.s()));
}

/// Where the slope vanishes by linear interpolation.
double levelling(const Place& low, const Place& high) {
  return (low.angle * high.slope - high.angle * low.slope) / (high.slope - low.slope);
}

/// True if no width between the two can be lower than the lower one by more than `enough`, for convex parts and for
/// concave ones (around the farthest point from a corner).
bool are_close(const Place& low, const Place& high, double enough) {
  const double gap = high.angle - low.angle;
  return std::min(-low.slope, high.slope) * gap + std::abs(low.translation.width) * gap * gap <= enough;
}

template <class At>
Translation lowest_on_arc(const At& at, double enough) {
  // Downhill from the middle, so that of two minima the nearer one is found.
  const Place middle = at(0), end = at(middle.slope < 0 ? patch : -patch);
  Translation best = middle.translation.width < end.translation.width ? middle.translation : end.translation;
  if (middle.slope * end.slope >= 0) return best;
  Place low = middle.slope < 0 ? middle : end, high = middle.slope < 0 ? end : middle;
  double tried = 0;
  for (int i = 0; i < most_steps && !are_close(low, high, enough); ++i) {
    const double gap = high.angle - low.angle;
    // One estimate for kinks, one for smooth parts, and after each a small step across it, so that both ends converge.
    if (i % 4 == 0)
      tried = meeting(low, high);
    else if (i % 4 == 2)
      tried = levelling(low, high);
    else
      tried += (tried == low.angle ? 1 : -1) * gap / 32;
    tried = std::clamp(tried, low.angle + gap / 256, high.angle - gap / 256);
    const Place next = at(tried);
    if (next.translation.width < best.width) best = next.translation;
    (next.slope < 0 ? low : high) = next;
  }
  // The weighted mean of both ends with slope zero.
  best.point = (high.slope * low.translation.point - low.slope * high.translation.point) / (high.slope - low.slope);
  return best;
}

/// The shortest separating translation over a patch around a direction.
Translation lowest_on_patch(const ShapePair& pair, const Vec& centre) {
  const Vec east = centre.unitOrthogonal(), north = centre.cross(east);
  const auto at_longitude = [&](double longitude) {
    const Vec equator = std::cos(longitude) * centre + std::sin(longitude) * east;
    const auto at_latitude = [&](double latitude) {
      const Vec unit = std::cos(latitude) * equator + std::sin(latitude) * north;
      const Translation translation = translation_along(pair, unit);
      return Place{latitude, translation.point.dot(std::cos(latitude) * north - std::sin(latitude) * equator),
                   translation};
    };
    const Translation translation = lowest_on_arc(at_latitude, pair.tolerance / 16);
    return Place{longitude, translation.point.dot(std::cos(longitude) * east - std::sin(longitude) * centre),
                 translation};
  };
  return lowest_on_arc(at_longitude, pair.tolerance / 4);
}

}  // namespace

Translation translation_along(const ShapePair& pair, const Vec& unit) {
  const Vec point = pair.a.core_support(unit) - pair.b.core_support(-unit);
  return {unit, unit.dot(point), point};
}

Translation local_minimum(const ShapePair& pair, const Vec& from) {
  Translation best = translation_along(pair, from);
  for (int i = 0; i < most_patches; ++i) {
    const Translation found = lowest_on_patch(pair, best.unit);
    const double gain = best.width - found.width;
    if (gain > 0) best = found;
    if (!(gain > pair.tolerance / 8)) break;
  }
  return best;
}

}  // namespace boxstream::ccd
