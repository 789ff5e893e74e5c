// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "simulation/effects/effect.hpp"

namespace boxstream::effects {

/// What of a scene will be wrong however its effects are set, one line each: bodies that are too small for its steps,
/// joints that no multibody can have. For people to read before a run.
std::vector<std::string> unfit(const Subject& subject);
std::vector<std::string> unfit(const scenes::Scene& scene);

}  // namespace boxstream::effects
