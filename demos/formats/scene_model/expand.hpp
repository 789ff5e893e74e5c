// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "formats/scene_model/scene.hpp"

namespace boxstream::scenes {

/// A scene's generators carried out: its explicit bodies and joints first, then what each generator makes, in order.
/// Depends on the scene and its seed alone. `shapes` begins with the scene's own and goes on with resized ones.
struct Expanded {
  std::vector<Shape> shapes;
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<std::array<std::size_t, 2>> exclusions;  // pairs of bodies that pass through each other

  /// Where what each generator makes begins, and one end more.
  std::vector<std::size_t> bodies_of_generator;
  std::vector<std::size_t> joints_of_generator;
};

Expanded expand(const Scene& scene);

/// JSON pointer of what a body or joint of the expansion comes from: "/bodies/2", or "/generators/0".
std::string pointer_of_body(const Expanded& expanded, std::size_t body);
std::string pointer_of_joint(const Expanded& expanded, std::size_t joint);

}  // namespace boxstream::scenes
