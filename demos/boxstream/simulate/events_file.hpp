// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxstream/simulate/simulate.hpp"

namespace boxstream::tool {

/// What the scene calls an object; empty if it has no name.
std::string object_name(const scenes::Simulation& simulation, std::size_t object);

/// A row for each object that entered or left a sensor, in order of steps, of the world asked for.
std::string events_table(const scenes::Scene& scene, const RunResult& result);

}  // namespace boxstream::tool
