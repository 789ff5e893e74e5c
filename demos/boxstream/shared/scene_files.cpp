// SPDX-License-Identifier: MIT
#include "boxstream/shared/scene_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "boxstream/shared/bad_input.hpp"
#include "formats/scene_json/load_scene.hpp"

namespace boxstream::tool {
namespace {

namespace fs = std::filesystem;

fs::path executable_directory() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

SceneKind kind_of(const fs::path& scene) {
  return scene.stem().string().starts_with("query_") ? SceneKind::query : SceneKind::simulation;
}

fs::path scenes_directory() {
  const fs::path here = executable_directory();
  for (const fs::path& place : {here / "scenes", here / ".." / "share" / "boxstream" / "scenes"}) {
    std::error_code error;
    if (fs::is_directory(place, error)) return place;
  }
  return {};
}

}  // namespace

std::vector<fs::path> shipped_scenes(SceneKind kind) {
  std::vector<fs::path> scenes;
  const fs::path place = scenes_directory();
  if (place.empty()) return scenes;
  for (const fs::directory_entry& entry : fs::directory_iterator(place))
    if (entry.path().extension() == ".json" && kind_of(entry.path()) == kind) scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

fs::path resolve_scene(const std::string& name, SceneKind kind) {
  if (name.ends_with(".json")) return name;
  // Those in folders are found by name and not listed: there is one for each effect.
  if (name.find('/') != std::string::npos) {
    const fs::path place = scenes_directory();
    std::error_code missing;
    const fs::path scene = place / (name + ".json");
    return !place.empty() && kind_of(scene) == kind && fs::is_regular_file(scene, missing) ? scene : fs::path(name);
  }
  std::vector<std::string> names;
  for (const fs::path& scene : shipped_scenes(kind)) {
    if (scene.stem() == name) return scene;
    names.push_back(scene.stem().string());
  }
  std::error_code error;
  if (fs::exists(name, error)) return name;
  const SceneKind other = kind == SceneKind::query ? SceneKind::simulation : SceneKind::query;
  for (const fs::path& scene : shipped_scenes(other))
    if (scene.stem() == name)
      throw BadInput(kind == SceneKind::query
                         ? fmt::format("{}: has no queries; boxstream simulate {} runs it", name, name)
                         : fmt::format("{}: is a scene of queries; boxstream query {} runs it", name, name));
  throw BadInput(fmt::format("{}: no such file, and no scene of that name{}; scenes: {}", name,
                             did_you_mean(name, names), fmt::join(names, ", ")));
}

scenes::Scene load_scaled(const std::string& name, double scale) {
  scenes::Scene scene = scenes::load_scene(resolve_scene(name, SceneKind::simulation).string());
  if (scale == 1) return scene;
  try {
    return scenes::scaled(scene, scale);
  } catch (const std::invalid_argument& error) {
    throw BadInput(fmt::format("--scale {}: {}", scale, error.what()));
  }
}

}  // namespace boxstream::tool
