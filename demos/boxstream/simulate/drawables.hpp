// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "pictures/drawing/poster.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::tool {

/// What to draw of a world as it is now: colours by kind of object and order of creation, sensors as wire frames.
std::vector<picture::Drawable> drawables(const scenes::Simulation& simulation);

/// What the colours of its bodies say.
picture::ColourBar creation_bar(const scenes::Simulation& simulation);

}  // namespace boxstream::tool
