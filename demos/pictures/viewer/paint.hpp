// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "simulation/engine/drawable.hpp"

namespace boxstream::view {

/// Colours of a film: bodies run through a palette in order of creation, so that mixing shows.
inline constexpr std::size_t paint_count = 12;

/// Of an object in the given state when the film began.
std::size_t paint_of(scenes::Drawable::State state, bool is_plane, std::uint32_t object, std::size_t objects);

/// As a glTF material.
nlohmann::ordered_json material_json(std::size_t paint);

}  // namespace boxstream::view
