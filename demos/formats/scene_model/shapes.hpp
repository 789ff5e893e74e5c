// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

struct BoxShape {
  Vec3 half_extents;
};
struct SphereShape {
  double radius;
};
/// Along local y; `height` is between the centres of the two end spheres.
struct CapsuleShape {
  double radius;
  double height;
};
/// Along local y; `height` is the whole height, centred.
struct CylinderShape {
  double radius;
  double height;
};
struct ConeShape {
  double radius;
  double height;
};
struct HullShape {
  std::vector<Vec3> points;
};
/// Fixed bodies only: the half-space { x : normal . x <= offset } is solid.
struct PlaneShape {
  Vec3 normal;
  double offset;
};
/// Fixed bodies only: a grid of heights, row after row along z, centred on the body's position in x and z.
struct HeightfieldShape {
  int columns;
  int rows;
  double cell;
  std::vector<float> heights;
};
/// Fixed bodies only.
struct MeshShape {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool internal_edges = false;  // keep bodies from stumbling over edges inside the surface
};
struct CompoundChild {
  std::size_t shape;  // an earlier convex shape
  Vec3 position;
  Quat rotation;
};
struct CompoundShape {
  std::vector<CompoundChild> children;
};

using ShapeValue = std::variant<BoxShape, SphereShape, CapsuleShape, CylinderShape, ConeShape, HullShape, PlaneShape,
                                HeightfieldShape, MeshShape, CompoundShape>;

struct Shape {
  std::string name;
  ShapeValue value;
};

}  // namespace boxstream::scenes
