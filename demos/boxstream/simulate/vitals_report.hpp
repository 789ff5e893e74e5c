// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "boxstream/simulate/simulate.hpp"

namespace boxstream::tool {

/// What went wrong in a world, and by how much, whether it was much or little: a line for each.
std::string vitals_lines(const WorldRun& world);

nlohmann::ordered_json vitals_json(const WorldRun& world);

/// Why a run cannot be trusted, beside what its checks and its energy say; empty: nothing is known against it.
std::string doubts(const WorldRun& world);

}  // namespace boxstream::tool
