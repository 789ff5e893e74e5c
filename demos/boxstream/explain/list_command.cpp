// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "base/words.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/scene_files.hpp"
#include "formats/scene_json/json_text.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/scene_error.hpp"

using namespace nlohmann::literals;

namespace boxstream::tool {
namespace {

struct ListOptions {
  bool details = false;  // sizes, tags and source, too
};

struct ListedScene {
  std::string name;
  int steps;  // 0: not known
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

/// What its file says, where this build cannot run it, or nothing can; `reason` is why.
ListedScene as_it_says(const std::filesystem::path& file, const std::string& reason) {
  ListedScene row{file.stem().string(), 0, "", ""};
  try {
    const nlohmann::json document = scenes::parse_json(scenes::read_text_file(file.string()), file.string());
    row.steps = document.value("/time/steps"_json_pointer, document.value("steps", 0));
    row.about = document.value("/meta/about"_json_pointer, "");
    row.details = document.value("/meta/source"_json_pointer, "");
  } catch (const std::exception&) {  // the reason says it
  }
  if (!reason.empty()) row.about += (row.about.empty() ? "[not here: " : " [not here: ") + reason + "]";
  row.about = files::printable(row.about);
  row.details = files::printable(row.details);
  return row;
}

ListedScene listed(const std::filesystem::path& file) {
  try {
    const scenes::Scene scene = scenes::load_scene(file.string());
    return {file.stem().string(), scene.time.steps, files::printable(scene.meta.about),
            files::printable(details_of(scene))};
  } catch (const scenes::SceneError& error) {
    const std::string text = error.what(), name = file.string() + ": ";
    return as_it_says(file, text.starts_with(name) ? text.substr(name.size()) : text);
  }
}

int run_list(const ListOptions& options) {
  const auto files = shipped_scenes(SceneKind::simulation);
  if (files.empty()) throw BadInput("no scenes beside the program");
  std::vector<ListedScene> rows;
  for (const auto& file : files) rows.push_back(listed(file));
  // Their loader is missing where FCL is.
  const std::vector<std::string>& missing = missing_commands();
  const bool has_queries = std::find(missing.begin(), missing.end(), "query") == missing.end();
  for (const auto& file : shipped_scenes(SceneKind::query))
    rows.push_back(as_it_says(file, has_queries ? "" : "the command query is not in this build, ./dev build makes it"));
  std::size_t width = 0;
  for (const ListedScene& row : rows) width = std::max(width, row.name.size());
  std::string text;
  for (const ListedScene& row : rows) {
    text += fmt::format("{:<{}} {:>5} steps   {}", row.name, width, row.steps, row.about);
    if (options.details && !row.details.empty()) text += fmt::format(" ({})", row.details);
    text += "\n";
  }
  print(text);
  return 0;
}

Action set_up_list(CommandLine& command) {
  const auto options = std::make_shared<ListOptions>();
  command.add_flag("--long", options->details, "What each has in it, too, its tags, and where its numbers are from");
  return [options] { return run_list(*options); };
}

}  // namespace

extern const Command list_command{"list", "Name the scenes that come with the tool", "", set_up_list};

}  // namespace boxstream::tool
