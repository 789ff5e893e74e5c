// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "inputs/hard.hpp"
#include "inputs/random.hpp"

namespace boxstream::batches {

namespace {

/// A box anywhere in the cube of an edge at the origin, its sides `side` at most and half of it at least.
Aabb64 anywhere(Random& random, double edge, double side) {
  Aabb64 box{};
  for (int d = 0; d < 3; ++d) {
    box.min[d] = random.real(0, edge);
    box.max[d] = box.min[d] + side * random.real(0.5, 1);
  }
  return box;
}

}  // namespace

Boxes heaps(std::size_t n, Random& random, const Heaps& how) {
  Boxes boxes;
  double edge = 1;
  for (int level = 0; level < how.depth; ++level) edge *= how.scale;
  double left = static_cast<double>(n);
  for (int level = 0; level <= how.depth; ++level) {
    const double here = level == how.depth ? left : left * (1 - how.share);
    const std::size_t end = level == how.depth ? n : boxes.size() + static_cast<std::size_t>(here);
    const double side = edge / cube_root(static_cast<std::size_t>(here) + 1);
    while (boxes.size() < std::min(end, n)) boxes.push_back(anywhere(random, edge, side));
    left -= here;
    edge /= how.scale;
  }
  random.shuffle(boxes);
  return boxes;
}

Boxes heaped(Boxes boxes, Random& random, const Heaps& how) {
  for (Aabb64& box : boxes) {
    double scale = 1;
    for (int level = 0; level < how.depth && random.unit() < how.share; ++level) scale /= how.scale;
    for (int d = 0; d < 3; ++d) {
      box.min[d] *= scale;
      box.max[d] *= scale;
    }
  }
  return boxes;
}

Boxes cantor_dust(std::size_t n, Random& random) {
  const double count = static_cast<double>(n);
  double side = 1;
  for (double points = 1; points < count; points *= 8) side /= 3;
  Boxes boxes(n);
  for (Aabb64& box : boxes)
    for (int d = 0; d < 3; ++d) {
      double third = 1, at = 0;
      for (std::uint64_t digits = random.next(), i = 0; i < 24; ++i, digits >>= 1) {
        third /= 3;
        at += (digits & 1) != 0 ? 2 * third : 0;
      }
      box.min[d] = at;
      box.max[d] = at + side * random.real(0.25, 0.75);
    }
  return boxes;
}

Boxes graded(std::size_t n, Random& random, int steps, double gap) {
  // A step is a cube of 2 c cells an edge without the c^3 next to the corner, which are the next step.
  int c = 1;
  while (static_cast<std::size_t>(7 * c * c * c * steps) < n) ++c;
  Boxes boxes;
  double cell = 1;
  for (int step = 0; step < steps; ++step, cell /= 2)
    for (int i = 0; i < 8 * c * c * c; ++i) {
      const int at[3] = {i % (2 * c), i / (2 * c) % (2 * c), i / (4 * c * c)};
      if (std::max({at[0], at[1], at[2]}) < c) continue;
      Aabb64 box{};
      for (int d = 0; d < 3; ++d) {
        box.min[d] = cell * at[d];
        box.max[d] = gap == 0 ? cell * (at[d] + 1) : cell * (at[d] + 1 - random.real(0, 2 * gap));
      }
      boxes.push_back(box);
    }
  random.shuffle(boxes);
  boxes.resize(n);
  return boxes;
}

Boxes coinciding(std::size_t n, Random& random, double share, int planes) {
  const double edge = cube_root(n), spacing = edge / planes;
  Boxes boxes(n);
  const auto moved = [&](double end) { return random.unit() < share ? spacing * std::floor(end / spacing) : end; };
  for (Aabb64& box : boxes) {
    box = anywhere(random, edge, 1);
    for (int d = 0; d < 3; ++d) {
      const double low = moved(box.min[d]), high = moved(box.max[d]);
      box.min[d] = std::min(low, high);
      box.max[d] = std::max(low, high);
    }
  }
  return boxes;
}

Boxes flattened(std::size_t n, Random& random, unsigned alike, unsigned thin) {
  int free = 0;
  for (int d = 0; d < 3; ++d) free += (alike >> d & 1) == 0 ? 1 : 0;
  const double count = static_cast<double>(n);
  const double edge = free == 1 ? count : free == 2 ? std::sqrt(count) : cube_root(n);
  Boxes boxes(n);
  for (Aabb64& box : boxes)
    for (int d = 0; d < 3; ++d) {
      const bool is_alike = (alike >> d & 1) != 0;
      box.min[d] = is_alike ? 1 : random.real(0, edge);
      box.max[d] = (thin >> d & 1) != 0 ? box.min[d] : is_alike ? 2 : box.min[d] + random.real(0.5, 1);
    }
  return boxes;
}

Boxes diagonal(std::size_t n, Random& random) {
  Boxes boxes(n);
  for (Aabb64& box : boxes) {
    const double at = random.real(0, static_cast<double>(n));
    for (int d = 0; d < 3; ++d) {
      const double centre = at + random.real(-1, 1), half = random.real(0.5, 1);
      box.min[d] = centre - half;
      box.max[d] = centre + half;
    }
  }
  return boxes;
}

Boxes city(std::size_t n, Random& random) {
  constexpr int squares = 4, clouds = 8;
  const double edge = 2 * std::sqrt(static_cast<double>(n)), square = edge / squares;
  Boxes boxes;
  for (int i = 0; i < squares * squares; ++i) {
    const double x = square * (i % squares), y = square * (i / squares);
    boxes.push_back({{x, y, -1}, {x + square, y + square, 0}});
  }
  for (int i = 0; i < clouds; ++i) boxes.push_back({{0, 0, 1000.0 + i}, {edge, edge, 1000.5 + i}});
  while (boxes.size() < n) {
    const double x = random.real(0, edge - 2), y = random.real(0, edge - 2);
    boxes.push_back({{x, y, 0}, {x + random.real(0.2, 2), y + random.real(0.2, 2), random.log_uniform(100)}});
  }
  boxes.resize(n);
  random.shuffle(boxes);
  return boxes;
}

Boxes voxels(std::size_t n, Random& random) {
  Boxes boxes = grid(2 * n, random);
  boxes.resize(n);
  return boxes;
}

Boxes pareto(std::size_t n, Random& random) {
  const double edge = 1.5 * cube_root(n);
  Boxes boxes(n);
  for (Aabb64& box : boxes) {
    const double side = std::min(0.3 / std::sqrt(1 - random.unit()), edge / 3);
    for (int d = 0; d < 3; ++d) {
      box.min[d] = random.real(0, edge - side);
      box.max[d] = box.min[d] + side;
    }
  }
  return boxes;
}

}  // namespace boxstream::batches
