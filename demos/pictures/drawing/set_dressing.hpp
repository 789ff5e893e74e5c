// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "camera.hpp"
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

/// Removes scenery boxes (walls, lids) that stand between the camera and the subjects, as a doll's house lacks its
/// front wall. Other scenery stays.
void cut_away(std::vector<Drawable>& drawables, const Camera& camera);

/// Puts a plane under everything, so that what stands on nothing still casts a shadow. Does nothing if there is a plane
/// already, or nothing to put it under.
void add_floor(std::vector<Drawable>& drawables);

}  // namespace boxstream::picture
