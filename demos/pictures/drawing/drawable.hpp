// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "vec3.hpp"

namespace boxstream::picture {

/// sRGB, each channel in [0, 1].
struct Colour {
  float r = 0.5F, g = 0.5F, b = 0.5F;
};

/// A rotation (its three columns, orthonormal) followed by a translation.
struct Transform {
  Vec3 column[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Vec3 origin;

  Vec3 direction(Vec3 v) const { return column[0] * v.x + column[1] * v.y + column[2] * v.z; }
  Vec3 point(Vec3 p) const { return direction(p) + origin; }
};

// Shapes are centred on the origin of their own frame, and cylinders and cones lie along y. Lengths are in the unit of
// the scene and positive.

struct Box {
  Vec3 half_extents;
};
struct Sphere {
  float radius;
};
/// A segment of length 2 * half_length with a radius: its overall length is 2 * (half_length + radius).
struct Capsule {
  float radius;
  float half_length;
  int axis = 1;  // 0, 1, 2 = x, y, z
};
struct Cylinder {
  float radius;
  float half_length;
};
/// The tip is at y = half_length.
struct Cone {
  float radius;
  float half_length;
};
/// The infinite plane y = 0 of its frame, drawn with a faint grid up to the horizon.
struct Plane {};
/// Triangles, for terrain, cloth and convex hulls. `smooth` blends normals over shared vertices.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool smooth = false;
};

using Shape = std::variant<Box, Sphere, Capsule, Cylinder, Cone, Plane, std::shared_ptr<const Mesh>>;

/// One thing to draw. Things with a coordinate that is not finite are left out of the picture.
struct Drawable {
  Shape shape;
  Transform transform;
  Colour colour;
  /// True: the automatic camera makes room for it. False for scenery, which may reach out of the picture.
  bool subject = true;
};

}  // namespace boxstream::picture
