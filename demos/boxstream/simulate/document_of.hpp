// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "formats/scene_model/scene.hpp"

namespace boxstream::tool {

/// What `boxstream simulate --json` says of a run.
nlohmann::json document_of(const scenes::Scene& scene, const std::string& broadphase);

}  // namespace boxstream::tool
