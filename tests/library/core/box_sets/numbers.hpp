// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/box_sets/scattered.hpp"

/// Boxes of numbers that are hard: infinities, NaNs, denormals, zeros of both signs, the largest.
namespace boxstream::tests::families {

/// One box in twenty has sides at infinity; a few are all of space, or lie at infinity themselves.
template <class S>
Boxes<S> infinite(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = 2 * cube_side(static_cast<double>(n));
  constexpr S inf = std::numeric_limits<S>::infinity();
  Boxes<S> boxes;
  while (boxes.size() < n) {
    BasicAabb<S> box = random_box<S>(random, side, 0, 1);
    if (random.chance(0.05))
      for (int d = 0; d < 3; ++d) {
        const int kind = random.integer(0, 5);
        if (kind == 1 || kind == 3) box.min[d] = -inf;
        if (kind == 2 || kind == 3) box.max[d] = inf;
        if (kind == 4) box.min[d] = box.max[d] = inf;
        if (kind == 5) box.min[d] = box.max[d] = -inf;
      }
    boxes.push_back(box);
  }
  return boxes;
}

/// Bounds of both zeros, one and minus one.
template <class S>
Boxes<S> signed_zeros(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const S zeros[2] = {S(0), -S(0)};
  Boxes<S> boxes;
  while (boxes.size() < n) {
    BasicAabb<S> box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = random.chance(0.2) ? -S(1) : random.chance(0.2) ? S(1) : zeros[random.index(2)];
      box.max[d] = box.min[d] > 0 || random.chance(0.2)   ? S(1)
                   : box.min[d] < 0 && random.chance(0.8) ? -S(1)
                                                          : zeros[random.index(2)];
    }
    boxes.push_back(box);
  }
  return boxes;
}

/// Numbers too small to be normal: a host that flushes them to zero sees all of these in one point.
template <class S>
Boxes<S> denormals(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const int side = 2 * static_cast<int>(cube_side(static_cast<double>(n)));
  constexpr S step = std::numeric_limits<S>::denorm_min();
  Boxes<S> boxes;
  while (boxes.size() < n) {
    BasicAabb<S> box{};
    for (int d = 0; d < 3; ++d) {
      const int at = random.integer(-side, side);
      box.min[d] = static_cast<S>(at) * step;
      box.max[d] = static_cast<S>(at + random.integer(0, 4)) * step;
    }
    boxes.push_back(box);
  }
  return boxes;
}

/// One in eight has NaNs, one in eight is inverted on some axis (often in ways that seem to overlap all others).
template <class S>
Boxes<S> invalid_among_valid(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const S nan = std::numeric_limits<S>::quiet_NaN(), inf = std::numeric_limits<S>::infinity();
  Boxes<S> boxes = dense<S>(n, seed);
  for (auto& box : boxes) {
    const int d = random.integer(0, 2);
    if (random.chance(0.125)) (random.chance(0.5) ? box.min : box.max)[d] = random.chance(0.5) ? nan : -nan;
    if (random.chance(0.0625)) std::swap(box.min[d], box.max[d]);
    if (random.chance(0.0625)) {
      box.min[d] = inf;
      box.max[d] = -inf;
    }
  }
  return boxes;
}

/// From the smallest to the largest number that S has, so that any width or centre overflows.
template <class S>
Boxes<S> full_range(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  using Limits = std::numeric_limits<S>;
  Boxes<S> boxes;
  while (boxes.size() < n) {
    BasicAabb<S> box{};
    for (int d = 0; d < 3; ++d) {
      S ends[2];
      for (S& end : ends) {
        // One after the other, for compilers differ in which argument they compute first.
        const int exponent = random.integer(Limits::min_exponent, Limits::max_exponent - 2);
        end = static_cast<S>(std::ldexp(1 + random.unit(), exponent));
        if (random.chance(0.05)) end = Limits::max();
        if (random.chance(0.5)) end = -end;
      }
      if (random.chance(0.7)) ends[1] = static_cast<S>(ends[0] * S(1.5));
      box.min[d] = ends[0] < ends[1] ? ends[0] : ends[1];
      box.max[d] = ends[0] < ends[1] ? ends[1] : ends[0];
    }
    boxes.push_back(box);
  }
  return boxes;
}

/// Bounds from a handful of values, special ones among them: nearly every comparison is a tie.
template <class S>
Boxes<S> ties(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  using Limits = std::numeric_limits<S>;
  const S values[] = {-Limits::infinity(),
                      -Limits::max(),
                      -1,
                      -Limits::denorm_min(),
                      -S(0),
                      S(0),
                      Limits::min(),
                      S(1),
                      std::nextafter(S(1), S(2)),
                      2,
                      Limits::max(),
                      Limits::infinity()};
  constexpr int last = static_cast<int>(std::size(values)) - 1;
  Boxes<S> boxes;
  while (boxes.size() < n) {
    BasicAabb<S> box{};
    for (int d = 0; d < 3; ++d) {
      const int lo = random.integer(0, last);
      const int hi = random.chance(0.8) ? std::min(lo + random.integer(0, 1), last) : random.integer(lo, last);
      box.min[d] = values[lo];
      box.max[d] = values[hi];
    }
    boxes.push_back(box);
  }
  return boxes;
}

/// Two groups at the ends of the number range, each of them small and dense.
template <class S>
Boxes<S> two_far_groups(std::size_t n, std::uint64_t seed) {
  Boxes<S> boxes = dense<S>(n, seed);
  for (std::size_t i = 0; i < n; i += 2)
    for (int d = 0; d < 3; ++d) {
      boxes[i].min[d] *= static_cast<S>(0x1p100);
      boxes[i].max[d] *= static_cast<S>(0x1p100);
    }
  return boxes;
}

}  // namespace boxstream::tests::families
