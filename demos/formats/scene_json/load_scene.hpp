// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "formats/scene_model/scene.hpp"

namespace boxstream::scenes {

/// Where a file or a folder of demos/scenes is, for programs that are run from the build tree:
/// "hard/mass_ratio_400.json". Without a path, that folder itself.
std::string shipped(std::string_view path = {});

/// Reads a scene file. Throws SceneError; a file that names other files (meshes) reads them too.
Scene load_scene(const std::string& path);

/// The same from text; `name` stands for the file in messages, and files that the scene names are looked up beside it.
Scene parse_scene(const std::string& text, const std::string& name);

}  // namespace boxstream::scenes
