// SPDX-License-Identifier: MIT
#pragma once

#include "shape_pair.hpp"

namespace boxstream::ccd {

/// A separating translation of two cores: B moved by `width` along `unit` leaves A. `point` is the support point of A -
/// B in that direction, or a mean of such points.
struct Translation {
  Vec unit;
  double width;
  Vec point;
};

Translation translation_along(const ShapePair& pair, const Vec& unit);

/// The shortest separating translation near a direction. Two nested searches, over latitude and longitude of a small
/// patch. Each keeps an interval with a minimum inside, so kinks do no harm.
Translation local_minimum(const ShapePair& pair, const Vec& from);

}  // namespace boxstream::ccd
