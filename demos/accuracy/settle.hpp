// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "formats/scene_model/scene.hpp"

namespace boxstream::accuracy {

/// How a scene comes to rest before anything is measured. Generated structures are placed with gaps between their
/// parts: without this, the fall through these gaps is measured, which is the same for all settings.
struct Settling {
  nlohmann::json change;    ///< of the scene's file while it settles (RFC 7396), such as more solver iterations
  std::uint64_t steps = 0;  ///< more than 0
};

struct Place {
  scenes::Vec3 position{};
  scenes::Quat rotation{0, 0, 0, 1};
};

/// Where the bodies of a scene are after `steps` steps, in the order of its expansion. Throws BadKnob if one of them is
/// then faster than `rest_speed`.
std::vector<Place> places_at_rest(scenes::Scene scene, const std::string& broadphase, std::uint64_t steps);

inline constexpr double rest_speed = 0.05;  ///< m/s

/// The scene with its generators carried out and its dynamic bodies at these places, without speed.
scenes::Scene placed(const scenes::Scene& scene, const std::vector<Place>& places);

}  // namespace boxstream::accuracy
