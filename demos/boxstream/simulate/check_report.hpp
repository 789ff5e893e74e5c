// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxstream/simulate/simulate.hpp"

namespace boxstream::tool {

/// A check in words: "max_penetration < 0.01, always".
std::string check_text(const scenes::Check& check);

/// One line for each check of the scene, with what it found in the first world; empty if the scene has none.
std::string check_lines(const scenes::Scene& scene, const RunResult& result);

/// The first check that failed in any world, as one line; empty if none did. One that was never evaluated has failed: a
/// run that is too short for it says nothing about it, and so does not pass.
std::string first_failed_check(const scenes::Scene& scene, const RunResult& result);

}  // namespace boxstream::tool
