// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace boxstream::scenes {

/// Units are SI; y is up.
using Vec3 = std::array<double, 3>;

/// Rotation as x, y, z, w of a unit quaternion.
using Quat = std::array<double, 4>;

struct Bounds {
  Vec3 min{};
  Vec3 max{};
};

}  // namespace boxstream::scenes
