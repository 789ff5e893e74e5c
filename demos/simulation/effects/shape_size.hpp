// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "formats/scene_model/shapes.hpp"

namespace boxstream::effects {

/// A shape's largest extent along its axes in metres, and the extent from which on Bullet's own contacts are accurate
/// enough for shapes of its kind. Both are 0 for a surface.
struct ShapeSize {
  double largest = 0, enough = 0;

  bool is_small() const { return largest < enough; }
};

ShapeSize size_of(const std::vector<scenes::Shape>& shapes, std::size_t index);

}  // namespace boxstream::effects
