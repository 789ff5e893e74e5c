// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace boxstream::scenes {

/// A scene's generators carried out: its explicit bodies and joints first, then what each generator makes, in order.
/// Depends on the scene and its seed alone. `shapes` begins with the scene's own and goes on with resized ones.
struct Expanded {
  std::vector<Shape> shapes;
  std::vector<Body> bodies;
  std::vector<Joint> joints;
};

Expanded expand(const Scene& scene);

}  // namespace boxstream::scenes
