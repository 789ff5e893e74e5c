// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/scene_json/json_node.hpp"

/// What scenes name: looked up beside the scene, and in its folder or below it, wherever `..`, absolute names and
/// symbolic links lead. Scenes of others may name any file of the machine.
namespace boxstream::scenes {

/// Of the scene that the node is in.
std::string folder_of(const Node& node);

/// The file, or the folder, that is there. Throw SceneError.
std::string file_beside(const Node& file);
std::string folder_beside(const Node& folder);

}  // namespace boxstream::scenes
