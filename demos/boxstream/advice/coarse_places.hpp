// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "boxstream/advice/coarse_steps.hpp"
#include "simulation/effects/effect.hpp"

namespace boxstream::tool {

/// Whether a body is so far from the origin that the spacing of floating-point numbers there is coarse against its
/// thickness, or against its motion in a step. Throws SceneError for a shape that cannot be built.
std::optional<CoarseStep> coarse_places(const effects::Subject& subject);

}  // namespace boxstream::tool
