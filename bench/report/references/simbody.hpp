// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "accuracy/trajectory.hpp"

namespace boxstream::scenes {
struct Scene;
}

namespace boxstream::report {

bool simbody_is_built();

/// Where Simbody has the dynamic bodies of a scene after each of `steps` steps of its length: see
/// witnesses/witness.hpp.
///
/// Throws BadExperiment for a scene that it does not know. Built without Simbody: an empty trajectory.
accuracy::Trajectory simbody_trajectory(const scenes::Scene& scene, std::uint64_t steps);

}  // namespace boxstream::report
