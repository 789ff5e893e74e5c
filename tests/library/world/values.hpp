// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <boxstream/aabb.hpp>
#include <boxstream/ray.hpp>

namespace boxstream::tests {

/// Numbers that have broken broad-phases before: a small grid on which touching is the rule, with 1-ulp neighbours, and
/// everything that arithmetic dislikes.
template <class S>
S hard_number(unsigned choice) {
  using Limits = std::numeric_limits<S>;
  const S two = 2;
  const S table[] = {0,
                     -S(0),
                     1,
                     2,
                     3,
                     4,
                     std::nextafter(two, S(1)),
                     std::nextafter(two, S(3)),
                     Limits::denorm_min(),
                     -Limits::denorm_min(),
                     Limits::min(),
                     Limits::max(),
                     -Limits::max(),
                     S(1e18),
                     S(-1e18),
                     Limits::infinity(),
                     -Limits::infinity(),
                     Limits::quiet_NaN()};
  return table[choice % (sizeof(table) / sizeof(table[0]))];
}

/// A box made of 24 bits or so: mostly small boxes on a grid of integers, sometimes points, sometimes hard numbers
/// as they come, NaN and inverted ones included.
template <class S>
BasicAabb<S> box_from(std::uint64_t bits, unsigned grid = 12) {
  std::minstd_rand random(static_cast<unsigned>(bits % 2147483646 + 1));
  const auto pick = [&](unsigned n) { return static_cast<unsigned>(random() >> 8) % n; };
  BasicAabb<S> box{};
  const bool hard = pick(5) == 0;
  for (int d = 0; d < 3; ++d) {
    if (hard && pick(2) == 0) {
      box.min[d] = hard_number<S>(pick(18));
      box.max[d] = hard_number<S>(pick(18));
      if (box.max[d] < box.min[d] && pick(4) != 0) std::swap(box.min[d], box.max[d]);
    } else {
      box.min[d] = S(pick(grid));
      box.max[d] = box.min[d] + S(pick(4));
    }
  }
  return box;
}

/// Half of the rays come by `along`, the rest have any inverse, extents and length.
template <class S>
BasicRay<S> ray_from(std::uint64_t bits) {
  std::minstd_rand random(static_cast<unsigned>(bits % 2147483646 + 1));
  const auto pick = [&](unsigned n) { return static_cast<unsigned>(random() >> 8) % n; };
  const auto small = [&] { return S(int(pick(25)) - 6) / 2; };
  const S origin[3] = {small(), small(), small()};
  const S direction[3] = {small(), pick(2) == 0 ? S(0) : small(), pick(3) == 0 ? S(0) : small()};
  const S lengths[] = {0, S(0.5), 1, 2, 10, std::numeric_limits<S>::max(), std::numeric_limits<S>::infinity()};
  auto ray = BasicRay<S>::along(origin, direction, lengths[pick(7)]);
  if (pick(3) == 0) {
    for (int d = 0; d < 3; ++d) {
      ray.extent_min[d] = -S(pick(3));
      ray.extent_max[d] = S(pick(3));
    }
  }
  if (pick(4) == 0)
    for (int d = 0; d < 3; ++d)
      if (direction[d] == 0) ray.inverse_direction[d] = pick(2) == 0 ? S(1e18) : S(-1e30);
  if (pick(6) == 0) {
    ray.origin[pick(3)] = hard_number<S>(pick(18));
    if (pick(2) == 0) ray.inverse_direction[pick(3)] = hard_number<S>(pick(18));
    if (pick(4) == 0) ray.extent_max[pick(3)] = hard_number<S>(pick(18));
    if (pick(4) == 0) ray.extent_min[pick(3)] = hard_number<S>(pick(18));
    if (pick(4) == 0) ray.length = hard_number<S>(pick(18));
  }
  return ray;
}

}  // namespace boxstream::tests
