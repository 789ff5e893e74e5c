// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

namespace boxstream::view_test {

/// At least one of everything that can be drawn.
inline scenes::Scene mixed_scene() {
  return scenes::load_scene(BOXSTREAM_VIEW_TESTS_DIR "/mixed.json");
}

}  // namespace boxstream::view_test
