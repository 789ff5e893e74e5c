// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace boxstream::scenes {

/// Units are SI; y is up.
using Vec3 = std::array<double, 3>;

/// Rotation as x, y, z, w of a unit quaternion.
using Quat = std::array<double, 4>;

inline Vec3 times(const Vec3& v, double factor) {
  return {v[0] * factor, v[1] * factor, v[2] * factor};
}

struct Bounds {
  Vec3 min{};
  Vec3 max{};
};

}  // namespace boxstream::scenes
