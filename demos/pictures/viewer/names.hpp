// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "pictures/viewer/kept.hpp"

namespace boxstream::view {

/// What each object that is kept is called: by the scene's name for it, or for its shape.
std::vector<std::string> names_of(const scenes::Simulation& simulation, const Kept& kept);

}  // namespace boxstream::view
