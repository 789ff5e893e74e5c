// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/ccd.hpp>
#include <string>
#include <vector>

namespace boxstream::tool {

/// A convex shape somewhere.
struct PlacedShape {
  std::string name;  // may be empty
  ccd::Shape shape;
  ccd::Pose pose;
};

/// Reads "shapes" and "bodies" as they are in scenes (demos/scenes/README.md), convex shapes only, bodies with "name",
/// "shape", "position" and "rotation". Throws scenes::SceneError.
std::vector<PlacedShape> parse_shapes(const std::string& text, const std::string& name);

}  // namespace boxstream::tool
