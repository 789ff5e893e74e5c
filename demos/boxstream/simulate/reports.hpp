// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "boxstream/simulate/simulate.hpp"
#include "formats/scene_model/scene.hpp"
#include "pictures/drawing/poster.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::tool {

/// The result as a page: each world as it is now under the same camera, the main numbers, and times and
/// pairs over the steps.
picture::Poster result_poster(const scenes::Scene& scene, const RunResult& result);

/// The result for reading: a small table, ending in a newline.
std::string result_table(const scenes::Scene& scene, const RunResult& result);

/// A check in words: "max_penetration < 0.01, always".
std::string check_text(const scenes::Check& check);

/// One line for each check of the scene, with what it found in the first world; empty if the scene has none.
std::string check_lines(const scenes::Scene& scene, const RunResult& result);

/// The first check that failed in any world, as one line; empty if none did. One that was never evaluated has failed: a
/// run that is too short for it says nothing about it, and so does not pass.
std::string first_failed_check(const scenes::Scene& scene, const RunResult& result);

/// Kinds of work with their names, in order.
std::array<std::pair<const char*, double>, 5> parts_of(const scenes::Work& work);

/// Lines for the summary: energy at the start and at the end, and what came in and went out. Empty where nothing has
/// any.
std::string energy_lines(const scenes::EnergyBalance& balance);

/// One line if steps gained energy that no work explains, else nothing.
std::string gained_energy(const scenes::Simulation& simulation);

/// What went wrong in a world, and by how much, whether it was much or little: a line for each.
std::string vitals_lines(const WorldRun& world);

nlohmann::ordered_json vitals_json(const WorldRun& world);

/// Why a run cannot be trusted, beside what its checks and its energy say; empty: nothing is known against it.
std::string doubts(const WorldRun& world);

}  // namespace boxstream::tool
