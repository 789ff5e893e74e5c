// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

namespace boxstream::mesh {

/// How far a point is from a surface. Of several triangles that are equally near, any one may be named.
struct Nearest {
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  double squared = std::numeric_limits<double>::infinity();  ///< the distance, squared
  std::uint32_t triangle = none;
};

}  // namespace boxstream::mesh
