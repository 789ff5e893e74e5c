// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/scene_model/scene.hpp"

namespace boxstream::tool {

/// Something in a scene that resembles a world that is known to be hard (docs/hard-worlds.md).
struct HardCase {
  std::string what;        ///< as "a chain of 160 joints: it stretches"
  std::string holds_with;  ///< settings with which the known one holds
  std::string scene;       ///< the known one with these settings
};

/// What the scene's settings are too weak for. Empty for most scenes. Throws SceneError for a shape that cannot be
/// built.
std::vector<HardCase> hard_cases(const scenes::Scene& scene);

}  // namespace boxstream::tool
