// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bad_input.hpp"
#include "commands.hpp"
#include "files/output_file.hpp"
#include "files/read_file.hpp"
#include "import/import_file.hpp"
#include "json_dump.hpp"
#include "print.hpp"
#include "scene/scene.hpp"

namespace boxstream::tool {
namespace {

using Json = nlohmann::ordered_json;

imports::ImportOptions options_of(const ImportOptions& options) {
  imports::ImportOptions result;
  if (options.up) result.z_up = *options.up == "z";
  result.fixed_base = options.fixed_base;
  result.hold = options.hold;
  result.keep_still = options.keep_still;
  result.density = options.density;
  result.packages = options.packages;
  if (options.hulls) result.parts = imports::PartsOptions{static_cast<std::size_t>(*options.hulls), options.error};
  return result;
}

/// Around the origins of all bodies, with room to move.
Json bounds_of(const Json& bodies) {
  constexpr double room = 10, farthest = 1e5;
  scenes::Vec3 low{}, high{};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto place = bodies[i]["position"].get<scenes::Vec3>();
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = i == 0 ? place[d] : std::min(low[d], place[d]);
      high[d] = i == 0 ? place[d] : std::max(high[d], place[d]);
    }
  }
  for (std::size_t d = 0; d < 3; ++d) {
    low[d] = std::clamp(low[d] - room, -farthest, farthest - 1);
    high[d] = std::clamp(high[d] + room, low[d] + 1, farthest);
  }
  return {{"min", low}, {"max", high}};
}

std::string unused(const Json& list, const std::string& wish) {
  std::string name = wish;
  const auto taken = [&](const Json& item) { return item["name"] == name; };
  while (std::any_of(list.begin(), list.end(), taken)) name += "_";
  return name;
}

void add_floor(Json& scene, double height) {
  const std::string shape = unused(scene["shapes"], "floor"), body = unused(scene["bodies"], "floor");
  scene["shapes"].push_back(Json{{"name", shape}, {"type", "plane"}, {"normal", {0, 1, 0}}, {"offset", height}});
  scene["bodies"].push_back(Json{{"name", body}, {"shape", shape}, {"type", "static"}});
}

/// One line for each shape, body and joint.
std::string laid_out(const Json& scene) {
  std::string text = "{\n";
  for (auto block = scene.begin(); block != scene.end(); ++block) {
    text += fmt::format("{}: ", json_dump(block.key(), -1));
    if (block->is_array()) {
      text += "[";
      for (std::size_t i = 0; i < block->size(); ++i)
        text += fmt::format("{}\n    {}", i > 0 ? "," : "", json_dump((*block)[i], -1));
      text += "\n  ]";
    } else {
      text += json_dump(*block, -1);
    }
    text += std::next(block) == scene.end() ? "\n" : ",\n";
  }
  return text + "}\n";
}

}  // namespace

int import_command(const ImportOptions& options) {
  files::note_read(options.file);
  files::OutputFile file(options.output);
  const Json parts = Json::parse(imports::import_file(options.file, options_of(options)));
  const std::filesystem::path path = options.file;
  Json scene{{"format", 1},
             {"meta", {{"name", path.stem().string()}, {"about", "imported from " + path.filename().string()}}},
             {"time", {{"dt", 1.0 / 60}}},
             {"world", {{"bounds", bounds_of(parts["bodies"])}}}};
  if (options.hold) {
    // The weight of a long arm takes a solver that goes over its joints one by one many small steps to carry.
    scene["time"]["substeps"] = 4;
    scene["solver"] = {{"iterations", 50}};
  }
  if (parts.contains("gravity")) scene["world"]["gravity"] = parts["gravity"];
  for (const char* const block : {"materials", "shapes", "bodies", "joints", "apart"})
    if (!parts[block].empty()) scene[block] = parts[block];
  if (options.floor) add_floor(scene, *options.floor);
  const std::string text = laid_out(scene);
  scenes::parse_scene(text, options.file);  // says what is wrong before anything is written
  file.stream() << text;
  file.commit();
  for (const Json& note : parts["notes"]) remark("note: " + note.get<std::string>());
  return 0;
}

}  // namespace boxstream::tool
