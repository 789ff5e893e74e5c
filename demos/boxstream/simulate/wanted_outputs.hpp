// SPDX-License-Identifier: MIT
#pragma once

#include "boxstream/simulate/options.hpp"
#include "formats/scene_model/scene.hpp"

namespace boxstream::tool {

/// What the command line and the scene's `outputs` block ask for together: recordings of both; of a page, a trace, a
/// table and a log of calls, which a run has one of, the command line's. They are entered in the scene, so that its
/// plan has them. Throws BadInput if the scene alone asks for two logs, or for a file outside of the current folder
/// without permission.
SimulateOptions with_outputs(const SimulateOptions& options, scenes::Scene& scene);

}  // namespace boxstream::tool
