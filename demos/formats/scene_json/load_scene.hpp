// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/scene_model/scene.hpp"

namespace boxstream::scenes {

/// Reads a scene file. Throws SceneError; a file that names other files (meshes) reads them too.
Scene load_scene(const std::string& path);

/// The same from text; `name` stands for the file in messages, and files that the scene names are looked up beside it.
Scene parse_scene(const std::string& text, const std::string& name);

}  // namespace boxstream::scenes
