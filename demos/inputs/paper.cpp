// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "inputs/generators.hpp"
#include "inputs/random.hpp"

namespace boxstream::batches {

namespace {

/// floor(n^power), at least 1.
std::int64_t power_of(std::size_t n, Power power) {
  const auto count = static_cast<std::int64_t>(n);
  switch (power) {
    case Power::zero:
      return 1;
    case Power::half:
      return floor_square_root(count);
    case Power::two_thirds:
      return floor_cube_root(count * count);
    case Power::one:
      break;
  }
  return count;
}

}  // namespace

// Integer coordinates, as the paper's "from 1 to n" reads: with a power of zero this makes 3 n / 2 pairs where real
// numbers would make n / 2, because intervals of length 1 also touch their neighbours.
Boxes balanced_or_skewed(std::size_t n, Random& random, Power x, Power y, Power z) {
  Boxes boxes(n);
  const Power powers[3] = {x, y, z};
  for (int d = 0; d < 3; ++d) {
    const std::int64_t longest = power_of(n, powers[d]);
    for (Aabb64& box : boxes) {
      const std::int64_t low = random.integer(1, static_cast<std::int64_t>(n) - longest);
      box.min[d] = static_cast<double>(low);
      box.max[d] = static_cast<double>(low + random.integer(1, longest));
    }
  }
  return boxes;
}

Boxes sphere_surface(std::size_t n, Random& random) {
  Boxes boxes(n);
  const double radius = static_cast<double>(n) / 2;
  const std::int64_t longest = std::max<std::int64_t>(1, floor_square_root(static_cast<std::int64_t>(n)));
  for (Aabb64& box : boxes) {
    // Marsaglia's method: a point in the unit disc, lifted to the sphere without trigonometry.
    double u, v, square;
    do {
      u = random.real(-1, 1);
      v = random.real(-1, 1);
      square = u * u + v * v;
    } while (square >= 1);
    const double lift = 2 * std::sqrt(1 - square);
    const double centre[3] = {radius * (u * lift), radius * (v * lift), radius * (1 - 2 * square)};
    for (int d = 0; d < 3; ++d) {
      const double half = static_cast<double>(random.integer(1, longest)) / 2;
      box.min[d] = centre[d] - half;
      box.max[d] = centre[d] + half;
    }
  }
  return boxes;
}

}  // namespace boxstream::batches
