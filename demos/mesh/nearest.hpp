// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace boxstream::mesh {

/// How far a point is from a surface. Of several triangles that are equally near, any one may be named.
struct Nearest {
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  double squared = std::numeric_limits<double>::infinity();  ///< the distance, squared
  std::uint32_t triangle = none;
};

/// Do two methods to find a distance agree? Which of two triangles that share the nearest point comes first can change
/// the last digits. `size`: of the surface, as its longest edge.
inline bool same_within_rounding(double squared_a, double squared_b, double size) {
  const double a = std::sqrt(squared_a), b = std::sqrt(squared_b);
  return std::abs(a - b) <= 32 * 0x1p-53 * (a + size);
}

}  // namespace boxstream::mesh
