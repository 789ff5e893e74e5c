// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "formats/scene_model/scene.hpp"
#include "simulation/effects/plan.hpp"

namespace boxstream::effects_test {

/// What happened while a scene ran, by name.
using Counts = std::map<std::string, double>;

/// Runs a scene from its first step to its last and counts what the engine was made of, what it did and how often its
/// hooks were called. Every counter is in the result, those that stayed at 0 too.
Counts count(const scenes::Scene& scene, effects::Extent extent = effects::Extent::only_called);

/// How often each of Bullet's profile zones was entered while a scene ran.
std::map<std::string, std::uint64_t> count_zones(const scenes::Scene& scene);

}  // namespace boxstream::effects_test
