// SPDX-License-Identifier: MIT
#pragma once

#include "papers/volumes/point.hpp"

namespace boxstream::papers::volumes {

/// { p : normal p <= offset }; the normal has any length but 0.
struct HalfSpace {
  Point normal;
  double offset;
};

struct Size {
  double area, volume;
};

/// Of the polytope that is the intersection: each plane's face is a square, cut down by all other half-spaces.
/// The polytope must lie within `radius` of `near`, a point inside it or not; no two half-spaces may be the same.
Size size_of(Span<const HalfSpace> half_spaces, const Point& near, double radius);

}  // namespace boxstream::papers::volumes
