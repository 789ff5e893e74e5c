// SPDX-License-Identifier: MIT
#pragma once

#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/scene.hpp"

namespace boxstream::view_test {

/// At least one of everything that can be drawn.
inline scenes::Scene mixed_scene() {
  return scenes::load_scene(BOXSTREAM_VIEW_TESTS_DIR "/mixed.json");
}

}  // namespace boxstream::view_test
