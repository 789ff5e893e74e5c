// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "camera.hpp"
#include "drawable.hpp"

namespace boxstream::picture {

/// Removes scenery boxes (walls, lids) that stand between the camera and the subjects, as a doll's house lacks its
/// front wall. Other scenery stays.
void cut_away(std::vector<Drawable>& drawables, const Camera& camera);

/// Puts a plane under everything, so that what stands on nothing still casts a shadow. Does nothing if there is a plane
/// already, or nothing to put it under.
void add_floor(std::vector<Drawable>& drawables);

}  // namespace boxstream::picture
