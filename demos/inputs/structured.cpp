// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>

#include "inputs/generators.hpp"
#include "inputs/random.hpp"

namespace boxstream::batches {

namespace {

/// Edge of the smallest cube of cells that has room for n.
std::size_t cells_along_edge(std::size_t n) {
  const auto floor = static_cast<std::size_t>(floor_cube_root(static_cast<std::int64_t>(n)));
  return floor * floor * floor == n ? floor : floor + 1;
}

}  // namespace

Boxes grid(std::size_t n, Random& random) {
  Boxes boxes(n);
  const std::size_t edge = cells_along_edge(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t cell[3] = {i % edge, i / edge % edge, i / (edge * edge)};
    for (int d = 0; d < 3; ++d) {
      boxes[i].min[d] = static_cast<double>(cell[d]);
      boxes[i].max[d] = static_cast<double>(cell[d] + 1);
    }
  }
  random.shuffle(boxes);
  return boxes;
}

Boxes identical(std::size_t n, Random&) {
  return Boxes(n, Aabb64{{-1, 2, 5}, {1, 3, 9}});
}

Boxes nested(std::size_t n, Random& random) {
  Boxes boxes(n);
  for (std::size_t i = 0; i < n; ++i)
    for (int d = 0; d < 3; ++d) {
      boxes[i].min[d] = -static_cast<double>(i + 1);
      boxes[i].max[d] = static_cast<double>(i + 1);
    }
  random.shuffle(boxes);
  return boxes;
}

// Plates fill x and z and follow each other along y, two apart. Teeth stand apart from each other in x and z and reach
// through eight plates, or all if there are fewer: every projection of the whole is crowded, the pairs are few.
Boxes comb_and_plates(std::size_t n, Random& random) {
  Boxes boxes(n);
  const std::int64_t plates =
      std::min<std::int64_t>(static_cast<std::int64_t>(n) / 2, floor_square_root(static_cast<std::int64_t>(n)));
  const std::size_t teeth = n - static_cast<std::size_t>(plates);
  const std::int64_t side = floor_square_root(static_cast<std::int64_t>(teeth)) + 1;
  const std::int64_t reach = std::min<std::int64_t>(8, plates);
  for (std::size_t i = 0; i < n; ++i) {
    Aabb64& box = boxes[i];
    if (i < teeth) {
      const auto tooth = static_cast<std::int64_t>(i);
      const auto x = static_cast<double>(2 * (tooth % side)), z = static_cast<double>(2 * (tooth / side));
      const auto first = static_cast<double>(2 * random.integer(0, plates - reach));
      box = {{x, first - 0.5, z}, {x + 1, first + 2 * static_cast<double>(reach) - 0.5, z + 1}};
    } else {
      const auto y = static_cast<double>(2 * (i - teeth)), end = static_cast<double>(2 * side);
      box = {{-1, y, -1}, {end, y + 1, end}};
    }
  }
  random.shuffle(boxes);
  return boxes;
}

// The boxes of a game world: small bodies, a box around the level, an unbounded plane whose box
// reaches +-1e18 (as Bullet's static planes do), and six half-spaces that touch that box from outside.
Boxes dust_and_planes(std::size_t n, Random& random) {
  const double far = 1e18, edge = 2 * cube_root(n);
  Boxes boxes;
  boxes.reserve(n + 8);
  boxes.push_back({{0, 0, 0}, {edge, edge, edge}});
  boxes.push_back({{-far, -far, -far}, {far, far, far}});
  for (int d = 0; d < 3; ++d) {
    Aabb64 below = boxes[1], above = boxes[1];
    below.max[d] = 0;
    above.min[d] = edge;
    boxes.push_back(below);
    boxes.push_back(above);
  }
  while (boxes.size() < n) {
    Aabb64 box{};
    for (int d = 0; d < 3; ++d) {
      const double side = random.real(0.25, 0.75);
      box.min[d] = random.real(0, edge - side);
      box.max[d] = box.min[d] + side;
    }
    boxes.push_back(box);
  }
  boxes.resize(n);
  random.shuffle(boxes);
  return boxes;
}

// Small integers make shared faces, edges, corners and equal boxes the rule; a side may have length zero.
Boxes touching_lattice(std::size_t n, Random& random) {
  Boxes boxes(n);
  const auto edge = static_cast<std::int64_t>(1.5 * cube_root(n));
  for (Aabb64& box : boxes)
    for (int d = 0; d < 3; ++d) {
      const std::int64_t low = random.integer(-edge / 2, edge - edge / 2 - 1);
      box.min[d] = static_cast<double>(low);
      box.max[d] = static_cast<double>(low + random.integer(0, 2));
    }
  return boxes;
}

}  // namespace boxstream::batches
