// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include <boxstream/span.hpp>

namespace boxstream::scenes {

/// One thing to draw. Compounds come as one drawable for each child; sensors as boxes, characters as capsules, wheels
/// as cylinders.
struct Drawable {
  enum class Kind {
    box,       ///< size = half extents
    sphere,    ///< size[0] = radius
    capsule,   ///< size[0] = radius, size[1] = half the distance between the end centres; along local y
    cylinder,  ///< size[0] = radius, size[1] = half height; along local y
    cone,      ///< size[0] = radius, size[1] = half height; along local y, apex up
    plane,     ///< size = unit normal; passes through `position`, without end
    triangles  ///< hulls, meshes, height fields, soft bodies: vertices and triangles, outward if closed
  };
  enum class State { fixed, kinematic, moving, sleeping, soft, sensor, character, wheel };

  Kind kind = Kind::box;
  State state = State::moving;
  /// Index of the object it belongs to, in order of creation: a key for colours. Wheels, which are rays and no objects,
  /// are numbered after all objects.
  std::uint32_t object = 0;
  std::array<float, 3> size{};
  std::array<float, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row after row; world = rotation * local + position
  std::array<float, 3> position{};
  Span<const std::array<float, 3>> vertices;  ///< local; valid until the Simulation goes or steps
  Span<const std::array<std::uint32_t, 3>> triangles;
};

}  // namespace boxstream::scenes
