// SPDX-License-Identifier: MIT
#include "boxstream/shared/scene_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "base/words.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"
#include "formats/scene_json/load_scene.hpp"

namespace boxstream::tool {
namespace {

namespace fs = std::filesystem;

SceneKind kind_of(const fs::path& scene) {
  return scene.stem().string().starts_with("query_") ? SceneKind::query : SceneKind::simulation;
}

fs::path scenes_directory() {
  const fs::path here = executable_directory();
  // From bin, and from libexec/boxstream.
  const fs::path shared = fs::path("share") / "boxstream" / "scenes";
  for (const fs::path& place : {here / "scenes", here / ".." / shared, here / ".." / ".." / shared}) {
    std::error_code error;
    if (fs::is_directory(place, error)) return place;
  }
  return {};
}

}  // namespace

fs::path executable_directory() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

std::vector<fs::path> shipped_scenes(SceneKind kind) {
  std::vector<fs::path> scenes;
  const fs::path place = scenes_directory();
  if (place.empty()) return scenes;
  for (const fs::directory_entry& entry : fs::directory_iterator(place))
    if (entry.path().extension() == ".json" && kind_of(entry.path()) == kind) scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

std::vector<std::string> scene_names(SceneKind kind) {
  std::vector<std::string> names;
  for (const fs::path& scene : shipped_scenes(kind)) names.push_back(scene.stem().string());
  if (kind == SceneKind::query || names.empty()) return names;
  const auto in_folders = static_cast<std::ptrdiff_t>(names.size());
  std::error_code missing;
  for (const char* const folder : {"effects", "hard"})
    for (const fs::directory_entry& entry : fs::directory_iterator(scenes_directory() / folder, missing))
      names.push_back(fmt::format("{}/{}", folder, entry.path().stem().string()));
  std::sort(names.begin() + in_folders, names.end());
  return names;
}

CLI::Option* add_scene(CommandLine& command, std::string& scene, SceneKind kind) {
  CLI::Option* const option = add_input(command, "SCENE", scene, "Scene file or name")->required();
  command.complete(option, [kind] { return scene_names(kind); });
  return option;
}

fs::path resolve_scene(const std::string& name, SceneKind kind) {
  if (name.ends_with(".json")) return name;
  const std::vector<std::string> names = scene_names(kind);
  if (std::find(names.begin(), names.end(), name) != names.end()) return scenes_directory() / (name + ".json");
  std::error_code error;
  if (fs::exists(name, error)) return name;
  const SceneKind other = kind == SceneKind::query ? SceneKind::simulation : SceneKind::query;
  for (const fs::path& scene : shipped_scenes(other))
    if (scene.stem() == name)
      throw BadInput(kind == SceneKind::query
                         ? fmt::format("{}: has no queries; boxstream simulate {} runs it", name, name)
                         : fmt::format("{}: is a scene of queries; boxstream query {} runs it", name, name));
  throw BadInput(
      fmt::format("unknown scene '{}'{} (no such file either; see boxstream list)", name, did_you_mean(name, names)));
}

void note_what_was_read(const scenes::Scene& scene) {
  if (!scene.old_words.empty()) remark(fmt::format("note: {}: {}", scene.file, fmt::join(scene.old_words, ", ")));
  for (const scenes::Generator& generator : scene.generators)
    if (const auto* const import = std::get_if<scenes::ImportGenerator>(&generator))
      for (const std::string& note : import->notes) remark(fmt::format("note: {}: {}", import->file, note));
}

scenes::Scene load_scaled(const std::string& name, double scale) {
  scenes::Scene scene = scenes::load_scene(resolve_scene(name, SceneKind::simulation).string());
  note_what_was_read(scene);
  if (scale == 1) return scene;
  try {
    return scenes::scaled(scene, scale);
  } catch (const std::invalid_argument& error) {
    throw BadInput(fmt::format("--scale {}: {}", scale, error.what()));
  }
}

}  // namespace boxstream::tool
