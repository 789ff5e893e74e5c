// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "drawable.hpp"

namespace boxstream::picture {

struct Ball {
  Vec3 centre;
  float radius;
};

/// A ball around a drawable in world coordinates; nothing for planes, empty meshes and whatever is not finite.
std::optional<Ball> bounding_ball(const Drawable& drawable);

/// The lowest y of a drawable in world coordinates: exact for boxes and meshes, that of the ball for the rest. Nothing
/// where there is no ball.
std::optional<float> lowest_point(const Drawable& drawable);

}  // namespace boxstream::picture
