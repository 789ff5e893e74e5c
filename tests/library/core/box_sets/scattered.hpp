// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "core/oracle.hpp"
#include "core/random.hpp"

/// Boxes at random, of several densities and sizes.
namespace boxstream::tests::families {

/// The smallest whole s with s^3 >= volume: a cube root that is the same on every machine.
inline double cube_side(double volume) {
  double side = 1;
  while (side * side * side < volume) ++side;
  return side;
}

/// Rounding to S keeps lo <= hi, for it is monotone.
template <class S>
BasicAabb<S> rounded(const double (&lo)[3], const double (&hi)[3]) {
  BasicAabb<S> box{};
  for (int d = 0; d < 3; ++d) {
    box.min[d] = static_cast<S>(lo[d]);
    box.max[d] = static_cast<S>(hi[d]);
  }
  return box;
}

template <class S>
BasicAabb<S> random_box(Random& random, double side, double smallest, double largest) {
  double lo[3], hi[3];
  for (int d = 0; d < 3; ++d) {
    lo[d] = random.between(0, side);
    hi[d] = lo[d] + random.between(smallest, largest);
  }
  return rounded<S>(lo, hi);
}

/// About half a pair per box.
template <class S>
Boxes<S> sparse(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = cube_side(static_cast<double>(n));
  Boxes<S> boxes;
  while (boxes.size() < n) boxes.push_back(random_box<S>(random, side, 0, 1));
  return boxes;
}

/// About ten pairs per box.
template <class S>
Boxes<S> dense(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = cube_side(static_cast<double>(n) * 8);
  Boxes<S> boxes;
  while (boxes.size() < n) boxes.push_back(random_box<S>(random, side, 1, 5));
  return boxes;
}

/// Tight clusters that are far apart.
template <class S>
Boxes<S> clusters(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const std::size_t count = 1 + n / 64;
  std::vector<double> centres(3 * count);
  for (double& centre : centres) centre = std::floor(random.between(-1000, 1000)) * 16;
  Boxes<S> boxes;
  while (boxes.size() < n) {
    const std::size_t cluster = random.index(count);
    double lo[3], hi[3];
    for (std::size_t d = 0; d < 3; ++d) {
      lo[d] = centres[3 * cluster + d] + random.unit() + random.unit() + random.unit();
      hi[d] = lo[d] + random.between(0, 0.5);
    }
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Sizes over six decades, the large ones few.
template <class S>
Boxes<S> six_decades(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = 8 * cube_side(static_cast<double>(n));
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3], hi[3];
    const int magnitude = random.chance(0.02) ? random.integer(3, 6) : random.integer(-14, 2);
    for (int d = 0; d < 3; ++d) {
      lo[d] = random.between(0, side);
      hi[d] = lo[d] + std::ldexp(1 + random.unit(), magnitude);
    }
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Dust, one box around the world, and half-spaces as physics engines make them.
template <class S>
Boxes<S> dust_and_planes(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = cube_side(static_cast<double>(n)), far = 1e18;
  Boxes<S> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 1000 == 0)
      boxes.push_back(rounded<S>({-far, -far, -far}, {far, far, 0}));
    else if (i % 1000 == 1)
      boxes.push_back(rounded<S>({-far, -far, -far}, {side / 2, far, far}));
    else if (i % 1000 == 2)
      boxes.push_back(rounded<S>({-1, -1, -1}, {side + 1, side + 1, side + 1}));
    else
      boxes.push_back(random_box<S>(random, side, 0.0001, 0.01));
  }
  random.shuffle(boxes);
  return boxes;
}

/// Everything in a flat layer.
template <class S>
Boxes<S> layer(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = std::floor(std::sqrt(static_cast<double>(n)) + 1);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3] = {random.between(0, side), random.between(0, side), random.unit()};
    const double hi[3] = {lo[0] + 1, lo[1] + 1, lo[2] + 1};
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// The surface of a ball of small boxes.
template <class S>
Boxes<S> sphere(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double radius = std::floor(std::sqrt(static_cast<double>(n) / 8) + 1);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double at[3], square = 0;
    for (double& x : at) {
      x = random.between(-1, 1);
      square += x * x;
    }
    if (square > 1 || square < 0.01) continue;
    const double scale = radius / std::sqrt(square);
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      lo[d] = at[d] * scale;
      hi[d] = lo[d] + 1;
    }
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

}  // namespace boxstream::tests::families
