// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxstream/simulate/simulate.hpp"
#include "formats/scene_model/scene.hpp"

namespace boxstream::tool {

/// The result for programs, as one JSON document ending in a newline; demos/boxstream/README.md lists its fields.
std::string result_json(const scenes::Scene& scene, const RunResult& result);

}  // namespace boxstream::tool
