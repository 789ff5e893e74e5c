// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/scene_model/scene.hpp"
#include "simulation/run/start_overlaps.hpp"

namespace boxstream::tool {

/// One line about bodies that start in each other, the deepest of them by number and name; empty if there are none.
std::string start_overlap_text(const scenes::Scene& scene, const scenes::StartOverlaps& overlaps);

}  // namespace boxstream::tool
