// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "boxstream/simulate/simulate.hpp"
#include "formats/scene_model/scene.hpp"

namespace boxstream::tool {

/// What `boxstream simulate --json` says of a run.
nlohmann::json document_of(const scenes::Scene& scene, const std::string& broadphase);

/// The result for programs, as one JSON document ending in a newline; demos/boxstream/README.md lists its fields.
std::string result_json(const scenes::Scene& scene, const RunResult& result);

}  // namespace boxstream::tool
