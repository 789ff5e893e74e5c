// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/printable.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/scene_files.hpp"
#include "formats/scene_json/json_text.hpp"
#include "formats/scene_json/load_scene.hpp"

using namespace nlohmann::literals;

namespace boxstream::tool {
namespace {

struct ListOptions {
  bool details = false;  // sizes, tags and source, too
};

struct Entry {
  std::string name;
  int steps;
  std::string about;
  std::string details;
};

std::string details_of(const scenes::Scene& scene) {
  std::string text;
  const auto add = [&](const std::optional<std::uint64_t>& count, const char* what) {
    if (count && *count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", *count, what);
  };
  const scenes::Expect& e = scene.expect;
  add(e.dynamic, "dynamic");
  add(e.kinematic, "kinematic");
  add(e.fixed, "static");
  add(e.joints, "joints");
  add(e.sensors, "sensors");
  add(e.characters, "characters");
  add(e.soft_bodies, "soft bodies");
  if (!scene.meta.tags.empty()) text += fmt::format("; tags: {}", fmt::join(scene.meta.tags, ", "));
  if (!scene.meta.source.empty()) text += fmt::format("; {}", scene.meta.source);
  return text;
}

int run_list(const ListOptions& options) {
  const auto files = shipped_scenes(SceneKind::simulation);
  if (files.empty()) throw BadInput("no scenes beside the program");
  std::vector<Entry> rows;
  for (const auto& file : files) {
    const scenes::Scene scene = scenes::load_scene(file.string());
    rows.push_back({file.stem().string(), scene.time.steps, files::printable(scene.meta.about),
                    files::printable(details_of(scene))});
  }
  // Listed also where FCL, and with it their loader, is missing.
  for (const auto& file : shipped_scenes(SceneKind::query)) {
    const nlohmann::json document = scenes::parse_json(scenes::read_text_file(file.string()), file.string());
    rows.push_back({file.stem().string(), document.value("steps", 0), document.value("/meta/about"_json_pointer, ""),
                    document.value("/meta/source"_json_pointer, "")});
  }
  std::size_t width = 0;
  for (const Entry& row : rows) width = std::max(width, row.name.size());
  std::string text;
  for (const Entry& row : rows) {
    text += fmt::format("{:<{}} {:>5} steps   {}", row.name, width, row.steps, row.about);
    if (options.details) text += fmt::format(" ({})", row.details);
    text += "\n";
  }
  print(text);
  return 0;
}

Action set_up_list(CLI::App& command) {
  const auto options = std::make_shared<ListOptions>();
  command.add_flag("--long", options->details, "What each has in it, too, its tags, and where its numbers are from");
  return [options] { return run_list(*options); };
}

}  // namespace

extern const Command list_command{"list", "Name the scenes that come with the tool", "", set_up_list};

}  // namespace boxstream::tool
