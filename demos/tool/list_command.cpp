// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "bad_input.hpp"
#include "commands.hpp"
#include "scene/scene.hpp"
#include "scene_files.hpp"

namespace boxstream::tool {

int list_command() {
  const auto files = shipped_scenes();
  if (files.empty()) throw BadInput("no scenes beside the program");
  for (const auto& file : files) {
    const scenes::Scene scene = scenes::load_scene(file.string());
    fmt::print("{:<12} {:>5} steps   {}\n", file.stem().string(), scene.time.steps, scene.meta.about);
  }
  return 0;
}

}  // namespace boxstream::tool
