// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

#include "core/box_sets/scattered.hpp"

/// Boxes whose arrangement is hard: ties, stacks, rods, lattices.
namespace boxstream::tests::families {

/// All share the origin.
template <class S>
Boxes<S> all_overlapping(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      lo[d] = -random.unit();
      hi[d] = random.unit();
    }
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

template <class S>
Boxes<S> identical(std::size_t n, std::uint64_t) {
  return Boxes<S>(n, BasicAabb<S>{{1, 2, 3}, {4, 5, 6}});
}

/// All low corners are the same: no split of low endpoints makes progress on any axis.
template <class S>
Boxes<S> equal_low(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    const double lo[3] = {1, 1, 1};
    const double hi[3] = {1 + random.unit(), 1 + random.unit(), 1 + random.unit()};
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Unit cubes on a lattice in random order: each touches up to 26 others, all ties.
template <class S>
Boxes<S> touching_lattice(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const auto side = static_cast<std::size_t>(cube_side(static_cast<double>(n)));
  Boxes<S> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const double lo[3] = {static_cast<double>(i % side), static_cast<double>(i / side % side),
                          static_cast<double>(i / side / side)};
    const double hi[3] = {lo[0] + 1, lo[1] + 1, lo[2] + 1};
    boxes.push_back(rounded<S>(lo, hi));
  }
  random.shuffle(boxes);
  return boxes;
}

/// Neighbours on axis 0 touch exactly or are one step of S apart, by chance.
template <class S>
Boxes<S> one_step_apart(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  S at = 1;
  for (std::size_t i = 0; i < n; ++i) {
    BasicAabb<S> box{{at, 0, 0}, {at + static_cast<S>(1), 1, 1}};
    for (int d = 1; d < 3; ++d)
      if (random.chance(0.1)) box.min[d] = box.max[d] = std::nextafter(S(1), random.chance(0.5) ? S(2) : S(1));
    boxes.push_back(box);
    at = random.chance(0.5) ? box.max[0] : std::nextafter(box.max[0], std::numeric_limits<S>::max());
  }
  random.shuffle(boxes);
  return boxes;
}

/// Lattice cubes whose faces are off by a few steps of double: as floats they all touch, as doubles half do.
template <class S>
Boxes<S> below_float(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = cube_side(static_cast<double>(n));
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      const double cell = std::floor(random.between(0, side));
      lo[d] = cell + 1 + random.integer(-4, 4) * 0x1p-40;
      hi[d] = cell + 2 + random.integer(-4, 4) * 0x1p-40;
    }
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Thin on one axis, and overlapping everything on the two others.
template <class S, int Axis>
Boxes<S> slices(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      lo[d] = -random.unit();
      hi[d] = random.unit();
    }
    lo[Axis] = random.between(0, static_cast<double>(n));
    hi[Axis] = lo[Axis] + random.unit();
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Long on one axis (`Axis`, or a random one for each box if it is 3), crossing half of the room.
template <class S, int Axis>
Boxes<S> rods(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = (Axis < 3 ? 2 : 4) * std::floor(std::sqrt(static_cast<double>(n)) + 1);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    const int axis = Axis < 3 ? Axis : random.integer(0, 2);
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      lo[d] = random.between(0, side);
      hi[d] = lo[d] + random.between(0.5, 1.5);
    }
    lo[axis] = random.between(0, side / 2);
    hi[axis] = lo[axis] + side / 2;
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Each box inside the one before.
template <class S>
Boxes<S> nested(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const auto r = static_cast<double>(i + 1);
    boxes.push_back(rounded<S>({-r, -r, -r}, {r, r, r}));
  }
  random.shuffle(boxes);
  return boxes;
}

/// Half are teeth and half are plates; every plate crosses every tooth on two axes, few do on the third, `Axis`.
template <class S, int Axis>
Boxes<S> comb_and_plates(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  constexpr int u = (Axis + 1) % 3, v = (Axis + 2) % 3;
  const auto count = static_cast<double>(n);
  Boxes<S> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<double>(i / 2);
    double lo[3], hi[3];
    const bool tooth = i % 2 == 0;
    lo[u] = tooth ? at : 0;
    hi[u] = tooth ? at + 0.5 : count;
    lo[v] = tooth ? 0 : at;
    hi[v] = tooth ? count : at + 0.5;
    lo[Axis] = random.between(0, count);
    hi[Axis] = lo[Axis] + random.unit();
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Points, segments and rectangles on a small lattice: many touch, none has volume.
template <class S>
Boxes<S> flat(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const int side = static_cast<int>(cube_side(static_cast<double>(n)));
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3], hi[3];
    const int thin = random.integer(0, 2);
    for (int d = 0; d < 3; ++d) {
      lo[d] = random.integer(0, side);
      hi[d] = d == thin || random.chance(0.5) ? lo[d] : lo[d] + 1;
    }
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// On one line, not parallel to an axis, in order: each touches the next at a corner.
template <class S>
Boxes<S> staircase(std::size_t n, std::uint64_t) {
  Boxes<S> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<double>(i);
    boxes.push_back(rounded<S>({at, -at - 1, at}, {at + 1, -at, at + 1}));
  }
  return boxes;
}

/// Every box spans the middle of axis 0 and of axis 1: an interval tree keeps them all at its root.
template <class S>
Boxes<S> spanning_the_median(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      lo[d] = -random.between(0.001, 1);
      hi[d] = random.between(0.001, 1);
    }
    lo[2] = random.unit() * static_cast<double>(n);
    hi[2] = lo[2] + random.between(0, 2);
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

}  // namespace boxstream::tests::families
