// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/scene.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::scenes_test {

/// What the loader says about a text that `file` stands for; empty if it takes it.
inline std::string complaint(const std::string& text, const std::string& file) {
  try {
    scenes::parse_scene(text, file);
  } catch (const scenes::SceneError& error) {
    return error.what();
  }
  return {};
}

}  // namespace boxstream::scenes_test
