// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pictures/viewer/kept.hpp"
#include "simulation/engine/drawable.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::view {

using Point = std::array<float, 3>;
using Rotation = std::array<float, 4>;  ///< unit quaternion: x, y, z, w
using Triangle = std::array<std::uint32_t, 3>;

inline constexpr Rotation no_rotation{0, 0, 0, 1};

/// A form at unit size, shared by all parts that differ from it in size only.
///   box: half extents 1; sphere: radius 1; cylinder, cone: radius and half height 1; plane: y = 0, without end;
///   capsule: radius 1, `ratio` = half the distance between the end centres; triangles: largest coordinate 1.
struct Form {
  scenes::Drawable::Kind kind = scenes::Drawable::Kind::box;
  float ratio = 0;
  std::vector<Point> vertices;
  std::vector<Triangle> triangles;
};

/// A form as a part of an object: scaled, rotated, then moved, in the coordinates of the object.
struct Part {
  std::uint32_t object = 0;
  std::uint32_t form = 0;
  Point scale{1, 1, 1};
  Point position{};
  Rotation rotation = no_rotation;
};

/// The surface of an object whose vertices move by themselves; they are in world coordinates.
struct SoftPart {
  std::uint32_t object = 0;
  std::uint32_t first_node = 0;  ///< in Snapshot::nodes
  std::uint32_t nodes = 0;
  std::vector<Triangle> triangles;
};

/// The appearance of a world; where its objects are is a Snapshot. Objects are those that are kept, by their places
/// among them.
struct Model {
  Kept kept;
  std::vector<Form> forms;
  std::vector<Part> parts;
  std::vector<SoftPart> soft_parts;
  std::vector<scenes::Drawable::State> states;  ///< of each object and wheel, when the model was made
  std::size_t wheels = 0;                       ///< behind the objects in `states`
};

Model model_of(const scenes::Simulation& simulation, Kept kept);
/// Of all objects.
Model model_of(const scenes::Simulation& simulation);

}  // namespace boxstream::view
