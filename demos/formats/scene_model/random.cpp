// SPDX-License-Identifier: MIT
#include "formats/scene_model/random.hpp"

#include <cmath>

namespace boxstream::scenes {

double Random::log_range(double low, double high) {
  return low * std::exp(unit() * std::log(high / low));
}

std::uint64_t Random::below(std::uint64_t count) {
  return static_cast<std::uint64_t>(unit() * static_cast<double>(count));
}

Vec3 Random::in_ball(double radius) {
  for (;;) {
    const double x = range(-1, 1), y = range(-1, 1), z = range(-1, 1);
    if (x * x + y * y + z * z <= 1) return {x * radius, y * radius, z * radius};
  }
}

Quat Random::rotation() {
  // A uniform point in the four-dimensional ball, pushed out to the sphere; points near the centre lose precision.
  for (;;) {
    const double x = range(-1, 1), y = range(-1, 1), z = range(-1, 1), w = range(-1, 1);
    const double squared = x * x + y * y + z * z + w * w;
    if (squared > 1 || squared < 0.01) continue;
    const double length = std::sqrt(squared);
    return {x / length, y / length, z / length, w / length};
  }
}

}  // namespace boxstream::scenes
