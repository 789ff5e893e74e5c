// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <utility>

#include "simulation/run/simulation.hpp"

namespace boxstream::tool {

/// Kinds of work with their names, in order.
std::array<std::pair<const char*, double>, 5> parts_of(const scenes::Work& work);

/// Lines for the summary: energy at the start and at the end, and what came in and went out. Empty where nothing has
/// any.
std::string energy_lines(const scenes::EnergyBalance& balance);

/// One line if steps gained energy that no work explains, else nothing.
std::string gained_energy(const scenes::Simulation& simulation);

}  // namespace boxstream::tool
