// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "accuracy/elsewhere.hpp"

namespace boxstream::tool {

/// Runs what this program cannot in the one for worlds in double precision; null: it is not installed.
accuracy::Elsewhere other_precision();

/// Results of running a scene with the settings that are worth trying on it.
struct Tried {
  std::string text;  ///< lines, for reading
  nlohmann::ordered_json json;
};

/// Runs the scene of a file for about so many seconds: from cheap settings to expensive ones, until no other can be
/// cheaper than one that is sound. Throws BadInput.
Tried try_settings(const std::string& scene, double seconds);

}  // namespace boxstream::tool
