// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "formats/scene_model/shapes.hpp"

namespace boxstream::effects {

/// A shape's largest extent along its axes in metres, and from which on Bullet's own contacts are good enough for it.
/// Both are 0 of a surface.
struct ShapeSize {
  double largest = 0, enough = 0;

  bool is_small() const { return largest < enough; }
};

ShapeSize size_of(const std::vector<scenes::Shape>& shapes, std::size_t index);

}  // namespace boxstream::effects
