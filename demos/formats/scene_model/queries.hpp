// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <variant>

#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

/// Rays that are cast after each step, from one point to points evenly spaced on a circle around the vertical through
/// it; the circle turns from step to step.
struct RayFan {
  static constexpr const char* kind = "rays";
  int count = 1;
  Vec3 from{};
  double radius = 1;
  double drop = 1;     // how far the circle is below the point
  double degrees = 1;  // of turning, in a step
};

/// Asks after each step for all boxes that touch one.
struct BoxQuery {
  static constexpr const char* kind = "box";
  Bounds bounds;
};

/// Asks after each step for all contacts of one body (Bullet's contactTest).
struct ContactQuery {
  static constexpr const char* kind = "contact";
  std::size_t body = 0;  // index of a body
};

using Query = std::variant<RayFan, BoxQuery, ContactQuery>;

}  // namespace boxstream::scenes
