// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace boxstream::batches {

/// Largest r with r^3 <= x, for x < 2^62. The guess is libm's, the result is not.
inline std::int64_t floor_cube_root(std::int64_t x) {
  auto r = static_cast<std::int64_t>(std::cbrt(static_cast<double>(x)));
  while (r * r * r > x) --r;
  while ((r + 1) * (r + 1) * (r + 1) <= x) ++r;
  return r;
}

/// Largest r with r^2 <= x, for x < 2^62.
inline std::int64_t floor_square_root(std::int64_t x) {
  auto r = static_cast<std::int64_t>(std::sqrt(static_cast<double>(x)));
  while (r * r > x) --r;
  while ((r + 1) * (r + 1) <= x) ++r;
  return r;
}

/// n^(1/3) to 20 bits, the same on every platform. For n < 2^31, at least 1.
inline double cube_root(std::size_t n) {
  const auto scaled = static_cast<std::int64_t>(n) << 30;
  return n == 0 ? 1.0 : static_cast<double>(floor_cube_root(scaled)) * 0x1p-10;
}

}  // namespace boxstream::batches
