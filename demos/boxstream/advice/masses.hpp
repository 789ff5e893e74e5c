// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "simulation/effects/effect.hpp"

namespace boxstream::tool {

/// Of each body, in kg; 0 of what is not dynamic. Throws SceneError for a shape that cannot be built.
std::vector<double> masses_of(const effects::Subject& subject);

}  // namespace boxstream::tool
