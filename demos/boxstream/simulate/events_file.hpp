// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxstream/simulate/simulate.hpp"

namespace boxstream::tool {

/// A row for each object that entered or left a sensor, in order of steps, of the world asked for.
std::string events_table(const scenes::Scene& scene, const RunResult& result);

}  // namespace boxstream::tool
