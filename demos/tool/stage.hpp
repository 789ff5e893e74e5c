// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "picture/drawable.hpp"
#include "simulation/simulation.hpp"

namespace boxstream::tool {

/// What to draw of a world as it is now: colours by kind of object and order of creation, sensors as wire frames.
std::vector<picture::Drawable> stage(const scenes::Simulation& simulation);

}  // namespace boxstream::tool
