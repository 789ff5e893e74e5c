// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "accuracy/trajectory.hpp"

namespace boxstream::scenes {
struct Scene;
}

namespace boxstream::report {

bool simbody_is_built();

/// Where Simbody's error-controlled integrator (Runge-Kutta-Merson, accuracy 1e-10) has the dynamic bodies of a scene
/// after each of `steps` steps of its length. It is given shapes, masses, places, velocities and gravity, not what an
/// engine made of them. It knows balls and boxes, ball joints and hinges without limits and motors, closed loops of
/// them too; no contacts, damping or fields.
///
/// Throws BadExperiment for a scene that has more. Built without Simbody: an empty trajectory.
accuracy::Trajectory simbody_trajectory(const scenes::Scene& scene, std::uint64_t steps);

}  // namespace boxstream::report
