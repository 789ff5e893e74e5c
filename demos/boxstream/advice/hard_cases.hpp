// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/scene_model/scene.hpp"

namespace boxstream::tool {

/// Something in a scene that resembles a world that is known to be hard (bench/results/hard-worlds.md).
struct HardCase {
  std::string what;    ///< as "a chain of 160 bodies ...: it stretches"
  std::string advice;  ///< a sentence: the settings with which such worlds held, or that none did
  std::string scene;   ///< a known one, of hard/; empty where it is no kind of world, but a limit of Bullet's
};

/// What the scene's settings are too weak for. Empty for most scenes. Throws SceneError for a shape that cannot be
/// built.
std::vector<HardCase> hard_cases(const scenes::Scene& scene);

}  // namespace boxstream::tool
