// SPDX-License-Identifier: MIT
#pragma once

#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/scene.hpp"
#include "source_path.hpp"

namespace boxstream::view_test {

/// At least one of everything that can be drawn.
inline scenes::Scene mixed_scene() {
  return scenes::load_scene(tests::source_path("tests/lab/pictures/mixed.json"));
}

}  // namespace boxstream::view_test
