// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_scene.hpp"

namespace boxstream::scenes {

std::string shipped(std::string_view path) {
  std::string file = BOXSTREAM_SCENES_DIR;
  if (!path.empty()) file.append("/").append(path);
  return file;
}

}  // namespace boxstream::scenes
