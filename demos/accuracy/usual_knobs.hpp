// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "knob.hpp"

namespace boxstream::accuracy {

/// Knobs that are worth trying on a scene: finer steps, more iterations, and the solvers that suit it. What the scene
/// has by itself is among their values.
std::vector<Knob> usual_knobs(const scenes::Scene& scene, bool has_doubles = false);

}  // namespace boxstream::accuracy
