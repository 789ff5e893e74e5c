// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "bad_input.hpp"
#include "commands.hpp"
#include "scene/json_text.hpp"
#include "scene/scene.hpp"
#include "scene_files.hpp"

using namespace nlohmann::literals;

namespace boxstream::tool {

int list_command() {
  const auto files = shipped_scenes(SceneKind::simulation);
  if (files.empty()) throw BadInput("no scenes beside the program");
  for (const auto& file : files) {
    const scenes::Scene scene = scenes::load_scene(file.string());
    fmt::print("{:<12} {:>5} steps   {}\n", file.stem().string(), scene.time.steps, scene.meta.about);
  }
  // Listed also where FCL, and with it their loader, is missing.
  for (const auto& file : shipped_scenes(SceneKind::query)) {
    const nlohmann::json document = scenes::parse_json(scenes::read_text_file(file.string()), file.string());
    const int steps = document.value("steps", 0);
    const std::string about = document.value("/meta/about"_json_pointer, "");
    fmt::print("{:<12} {:>5} steps   {}\n", file.stem().string(), steps, about);
  }
  return 0;
}

}  // namespace boxstream::tool
