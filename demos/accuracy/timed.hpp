// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "formats/scene_model/scene.hpp"

namespace boxstream::accuracy {

/// Milliseconds for a simulated second of so many steps: processor time; of several threads elapsed time. Building the
/// world is not in it.
double timed(scenes::Scene scene, const std::string& broadphase, std::uint64_t steps);

}  // namespace boxstream::accuracy
