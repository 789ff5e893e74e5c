// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "boxstream/advice/coarse_steps.hpp"
#include "simulation/effects/effect.hpp"

namespace boxstream::tool {

/// The body that flies deepest into a fixed box, of what flies freely until it hits something, if that is more than
/// half of the thinner of the two: step for step as the engine moves it. Nothing where fields push bodies about.
std::optional<CoarseStep> deep_landing(const effects::Subject& subject);

}  // namespace boxstream::tool
