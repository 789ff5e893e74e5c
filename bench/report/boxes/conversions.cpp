// SPDX-License-Identifier: MIT
#include "boxes/conversions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boxstream::report {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double places = 65536;

float down(double value) {
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) > value ? std::nextafter(nearest, -infinity) : nearest;
}

float up(double value) {
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) < value ? std::nextafter(nearest, infinity) : nearest;
}

}  // namespace

Aabb nearest_floats(const Aabb64& box) {
  Aabb nearest{};
  for (int d = 0; d < 3; ++d) {
    nearest.min[d] = static_cast<float>(box.min[d]);
    nearest.max[d] = static_cast<float>(box.max[d]);
  }
  return nearest;
}

Aabb outward_floats(const Aabb64& box) {
  Aabb outward{};
  for (int d = 0; d < 3; ++d) {
    outward.min[d] = down(box.min[d]);
    outward.max[d] = up(box.max[d]);
  }
  return outward;
}

bool contains(const Aabb& outer, const Aabb64& inner) {
  for (int d = 0; d < 3; ++d)
    if (!(static_cast<double>(outer.min[d]) <= inner.min[d] && inner.max[d] <= static_cast<double>(outer.max[d])))
      return false;
  return true;
}

Lattice16::Lattice16(const Aabb64& world) {
  for (int d = 0; d < 3; ++d) {
    low_[d] = world.min[d];
    cell_[d] = (world.max[d] - world.min[d]) / places;
  }
}

Aabb Lattice16::outward(const Aabb& box) const {
  Aabb outward{};
  for (int d = 0; d < 3; ++d) {
    const auto low = static_cast<double>(box.min[d]), high = static_cast<double>(box.max[d]);
    // In doubles throughout: a NaN stays one, where a conversion to integers would be undefined.
    const auto place = [&](double x) { return std::clamp(std::floor((x - low_[d]) / cell_[d]), 0.0, places - 1); };
    const double even = 2 * std::floor(place(low) / 2), odd = 2 * std::floor(place(high) / 2) + 1;
    // The upper bound stays below the next even place, where another box may begin.
    const float below = std::nextafter(down(low_[d] + (odd + 1) * cell_[d]), -infinity);
    // Both are what they were where rounding, or the end of the world, left a part of the box outside.
    outward.min[d] = std::min(box.min[d], down(low_[d] + even * cell_[d]));
    outward.max[d] = std::max(box.max[d], below);
  }
  return outward;
}

Aabb cube_around(const Aabb& box) {
  double half = 0;
  for (int d = 0; d < 3; ++d)
    half = std::max(half, (static_cast<double>(box.max[d]) - static_cast<double>(box.min[d])) / 2);
  Aabb64 cube{};
  for (int d = 0; d < 3; ++d) {
    const double centre = (static_cast<double>(box.min[d]) + static_cast<double>(box.max[d])) / 2;
    cube.min[d] = std::min(centre - half, static_cast<double>(box.min[d]));
    cube.max[d] = std::max(centre + half, static_cast<double>(box.max[d]));
  }
  return outward_floats(cube);
}

}  // namespace boxstream::report
