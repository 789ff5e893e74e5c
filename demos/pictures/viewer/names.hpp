// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/scene_model/scene.hpp"

namespace boxstream::view {

/// What each object of a scene is called, in order of creation: by the scene's name for it, or for its shape.
std::vector<std::string> names_of(const scenes::Scene& scene);

}  // namespace boxstream::view
