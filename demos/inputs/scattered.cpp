// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "inputs/generators.hpp"
#include "inputs/random.hpp"

namespace boxstream::batches {

// Two boxes with independent sides of mean s, thrown into a cube of edge L, overlap with probability (2 s / L)^3, but
// for the faces of the cube, where neighbours are missing. The edges L below follow from that and the wanted number of
// pairs; where the arithmetic is not as simple they were fitted at n = 10^5.

Boxes dense(std::size_t n, Random& random) {
  Boxes boxes(n);
  const double edge = cube_root(n);
  for (Aabb64& box : boxes)
    for (int d = 0; d < 3; ++d) {
      box.min[d] = random.real(0, edge);
      box.max[d] = box.min[d] + random.real(0.25, 1.75);
    }
  return boxes;
}

Boxes many_sizes(std::size_t n, Random& random, double spacing) {
  Boxes boxes(n);
  const double smallest = 0.01;
  const double edge = spacing * cube_root(n);
  for (Aabb64& box : boxes) {
    const double size = smallest * random.log_uniform(1000);
    for (int d = 0; d < 3; ++d) {
      box.min[d] = random.real(0, edge);
      box.max[d] = box.min[d] + size * random.real(0.75, 1.25);
    }
  }
  return boxes;
}

Boxes flat_layer(std::size_t n, Random& random, int thin) {
  Boxes boxes(n);
  const double edge = 0.98 * std::sqrt(static_cast<double>(n));
  for (Aabb64& box : boxes)
    for (int d = 0; d < 3; ++d) {
      box.min[d] = random.real(0, d == thin ? 1 : edge);
      box.max[d] = box.min[d] + random.real(0.5, 1.5);
    }
  return boxes;
}

Boxes clusters(std::size_t n, Random& random) {
  Boxes boxes(n);
  const std::size_t per_cluster = 500;
  const std::size_t count = std::max<std::size_t>(1, n / per_cluster);
  const double spread = 2.85;
  const double edge = 8 * spread * cube_root(count);
  std::vector<double> centres(3 * count);
  for (double& coordinate : centres) coordinate = random.real(0, edge);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t cluster = i % count;
    for (int d = 0; d < 3; ++d) {
      boxes[i].min[d] = centres[3 * cluster + static_cast<std::size_t>(d)] + spread * random.gaussian();
      boxes[i].max[d] = boxes[i].min[d] + random.real(0.5, 1.5);
    }
  }
  return boxes;
}

// Rods of different directions meet where their thin sides do, in one dimension: n^2 / 3 * 2 t / L pairs for full
// length rods of thickness t, so t shrinks as 1 / n to keep pairs per box constant.
Boxes rods(std::size_t n, Random& random) {
  Boxes boxes(n);
  const double edge = 1000;
  const double thickness = std::min(0.05, 95 / static_cast<double>(n)) * edge;
  for (std::size_t i = 0; i < n; ++i)
    for (int d = 0; d < 3; ++d) {
      const bool along = i % 3 == static_cast<std::size_t>(d);
      const double side = along ? random.real(0.5, 1) * edge : thickness * random.real(0.5, 1.5);
      boxes[i].min[d] = random.real(0, edge - side);
      boxes[i].max[d] = boxes[i].min[d] + side;
    }
  random.shuffle(boxes);
  return boxes;
}

}  // namespace boxstream::batches
