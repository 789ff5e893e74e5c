// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "base/keys.hpp"

namespace boxstream::detail {

/// Throws unless it is finite and >= 0. By its bits: to compare a signalling NaN traps.
inline void check_tolerance(double tolerance) {
  const auto bits = std::bit_cast<std::uint64_t>(tolerance);
  if (bits >= std::uint64_t{0x7ff0000000000000} && bits != std::uint64_t{1} << 63)
    throw std::invalid_argument("boxstream: a tolerance must be finite and not below 0");
}

/// Of one that has been checked. By its bits: a host may take subnormal numbers for zero.
inline bool is_zero(double tolerance) {
  return std::bit_cast<std::uint64_t>(tolerance) << 1 == 0;
}

/// The number next to x, below or above it.
template <class S>
S next_to(S x, int direction) {
  auto key = order_key(x) + direction;
  if (key == -1) key += direction;  // it would be another zero
  return std::bit_cast<S>(key ^ ((key >> (8 * sizeof(S) - 1)) & std::numeric_limits<decltype(key)>::max()));
}

/// A high end in whose place boxes are compared: the largest number of type S that is not above high + tolerance, or,
/// of open boxes, the smallest that is not below it. No coordinate lies between it and the sum, so nothing is lost. In
/// the default floating-point environment.
template <class S>
S raised(S high, double tolerance, Faces faces) {
  if (!(std::abs(high) <= std::numeric_limits<S>::max())) return high;
  const double x = high, sum = x + tolerance;
  if (!(sum <= std::numeric_limits<double>::max()))
    return faces == Faces::open ? std::numeric_limits<S>::infinity() : std::numeric_limits<S>::max();
  const double part = sum - x, lost = (x - (sum - part)) + (tolerance - part);  // sum + lost is the sum, exactly
  const S rounded = static_cast<S>(sum);
  const double off = rounded == sum ? -lost : rounded > sum ? 1 : -1;  // in its sign
  if (faces == Faces::closed) return off > 0 ? next_to(rounded, -1) : rounded;
  return off < 0 ? next_to(rounded, 1) : rounded;
}

/// The same of all high ends of a box that is valid.
template <class S>
void raise(BasicAabb<S>& box, double tolerance, Faces faces) {
  for (S& high : box.max) high = raised(high, tolerance, faces);
}

}  // namespace boxstream::detail
