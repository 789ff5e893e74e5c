// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/output_file.hpp"
#include "base/read_file.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"
#include "formats/import/import_file.hpp"
#include "formats/scene_json/json_text.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::tool {
namespace {

struct ImportOptions {
  std::string file;
  std::string output;             // "-": standard output
  std::optional<std::string> up;  // "y" or "z"; none: as is usual for the kind of file
  std::optional<double> floor;    // a ground plane at this height; none: no ground
  bool fixed_base = false;
  bool hold = false;
  bool keep_still = false;
  double scale = 1;  // of a mesh
  std::optional<double> density;
  std::optional<int> hulls;  // most convex parts of a mesh; none: as is usual
  double error = 0.05;
  std::vector<std::string> packages;  // URDF: folders that package:// may mean
};

using Json = nlohmann::ordered_json;

imports::ImportOptions options_of(const ImportOptions& options) {
  imports::ImportOptions result;
  if (options.up) result.z_up = *options.up == "z";
  result.fixed_base = options.fixed_base;
  result.hold = options.hold;
  result.keep_still = options.keep_still;
  result.scale.fill(options.scale);
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

int run_import(const ImportOptions& options) {
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
  for (const char* const block : {"materials", "shapes", "bodies", "joints", "exclusions"})
    if (!parts[block].empty()) scene[block] = parts[block];
  if (options.floor) add_floor(scene, *options.floor);
  const std::string text = laid_out(scene);
  try {
    scenes::parse_scene(text, options.file);  // says what is wrong before anything is written
  } catch (const scenes::SceneError& error) {
    throw scenes::SceneError(scenes::with_name(error.what(), options.file, nlohmann::json::parse(text)));
  }
  file.stream() << text;
  file.commit();
  for (const Json& note : parts["notes"]) remark("note: " + note.get<std::string>());
  return 0;
}

Action set_up_import(CommandLine& command) {
  const auto options = std::make_shared<ImportOptions>();
  add_input(command, "FILE", options->file, ".urdf, .bullet, .obj, .stl, .ply, .off, .dae, .gltf or .glb")->required();
  add_file(command, "-o,--output", options->output, "Scene to write; - is standard output")->required();
  take_words(command,
             add_name(command, "--up", options->up, "The file's upward axis, {}; default: z for .urdf, else y"), "axis",
             {"y", "z"});
  add_number(command, "--floor", options->floor, "Add a ground plane at this height", -1e5, 1e5, "Y");
  command.add_flag("--fixed-base", options->fixed_base, "URDF: the root link does not move");
  command.add_flag("--hold", options->hold, "URDF: motors that keep joints where they are, as strong as their effort");
  command
      .add_option("--package-path", options->packages,
                  "URDF: folder that package:// means, or that holds it; may be repeated")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory);
  command.add_flag("--static", options->keep_still, "Mesh: a static triangle mesh in place of convex parts");
  add_number(command, "--scale", options->scale, "Mesh: metres for each unit of the file, 0.001 for mm; default: 1",
             1e-6, 1e4, "S");
  add_number(command, "--density", options->density, "kg/m^3 of meshes (1000) and of links without a mass (an error)",
             1e-6, 1e5, "D");
  add_number(command, "--hulls", options->hulls, "Cut meshes into up to N convex parts; 16, for URDF 1", 1, 256);
  add_number(command, "--error", options->error, "With --hulls: volume that is enough, as a fraction; default: 0.05",
             0.0, 100.0, "E");
  return [options] { return run_import(*options); };
}

}  // namespace

extern const Command import_command{"import", "Make a scene of a robot, a world or a mesh",
                                    R"(Examples:
  boxstream import robot.urdf -o robot.json --fixed-base --floor 0
  boxstream import arm.urdf -o arm.json --hold --package-path ~/ros/src
  boxstream import world.bullet -o world.json
  boxstream import part.stl -o part.json --up z --hulls 32 --floor -1

FILE is a robot (.urdf), a world (.bullet) or a mesh (.obj, .stl, .ply, .off, .dae, .gltf, .glb). A mesh becomes one body
of convex parts; its file does not say its unit, which is a metre unless --scale says otherwise. What scenes cannot
express is named on standard error, a line each. Scenes can also name such files themselves: generators of type import,
shapes with "file".

Exit code: 0; 2 for a file that cannot be read or carried over, with nothing written.)",
                                    set_up_import};

}  // namespace boxstream::tool
