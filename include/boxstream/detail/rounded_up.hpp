// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

// Numbers of other languages are doubles, those of a world may be floats. For the default environment.
namespace boxstream::detail {

/// The least number of S that is not below `x`; a NaN stays one.
template <class S>
S rounded_up(double x) {
  const S nearest = static_cast<S>(x);
  return nearest < x ? std::nextafter(nearest, std::numeric_limits<S>::infinity()) : nearest;
}

/// A limit or the length of a ray, rounded so that nothing is lost. A negative one, which nothing is within, stays
/// negative: rounded up it could be -0, which a ray that starts inside of a box is within.
template <class S>
S limit_of(double x) {
  return x < 0 ? S{-1} : rounded_up<S>(x);
}

}  // namespace boxstream::detail
