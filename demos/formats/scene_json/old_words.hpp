// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace boxstream::scenes {

/// Puts the words of today in the place of those that scene files had until 0.1: "apart" is "exclusions", fields of
/// type "swirl" and "kicks" are "vortex" and "impulses", grids have a "vortex", generators of type "rain" are
/// "respawn"; likewise the names of effects that are required or forbidden. A document that has both words stays as it
/// is, for the loader to refuse.
///
/// Returns what it replaced, each word once, as in `"apart" is "exclusions" now`.
std::vector<std::string> renew_words(nlohmann::json& scene);

}  // namespace boxstream::scenes
