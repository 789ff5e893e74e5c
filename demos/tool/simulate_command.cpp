// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "aabbs_file.hpp"
#include "bad_input.hpp"
#include "broadphase_name.hpp"
#include "commands.hpp"
#include "csv_file.hpp"
#include "files/output_file.hpp"
#include "json_report.hpp"
#include "log_file.hpp"
#include "picture/poster.hpp"
#include "poster_report.hpp"
#include "print.hpp"
#include "recordings.hpp"
#include "scene/scene.hpp"
#include "scene_files.hpp"
#include "simulate.hpp"
#include "summary.hpp"
#include "table.hpp"
#include "verdict_report.hpp"
#include "wanted_outputs.hpp"

namespace boxstream::tool {

int simulate_command(const SimulateOptions& given) {
  // Everything the user may have got wrong is found out before the first step.
  if (given.broadphase) check_broadphase(*given.broadphase);
  if (given.compare) check_broadphase(*given.compare);
  const auto format = picture::picture_format(given.picture);
  if (!given.picture.empty() && !format)
    throw BadInput(fmt::format("{}: a picture is a .png or a .svg file", given.picture));
  if (given.log == "-") throw BadInput("--log -: a recording is a file");
  for (const std::string& file : given.record)
    if (!file.ends_with(".aabbs") && !file.ends_with(".glb"))
      throw BadInput(fmt::format("--record {}: expected a file FILE.aabbs or FILE.glb", file));
  scenes::Scene scene = load_scaled(given.scene, given.scale);
  const SimulateOptions options = with_outputs(given, scene);
  // A scene that is run for longer or shorter may call for other effects.
  if (options.steps) scene.time.steps = static_cast<int>(*options.steps);
  const auto steps = static_cast<std::uint64_t>(scene.time.steps);
  const auto extent = options.all_effects ? effects::Extent::all : effects::Extent::only_called;
  effects::plan(scene, extent);  // throws if the scene's wishes about effects are not met
  std::optional<files::OutputFile> json_file;
  std::optional<files::OutputFile> picture_file;
  std::optional<LogFile> log_file;  // outlives the world that it records
  std::vector<std::unique_ptr<AabbsFile>> boxes;
  if (!options.json.empty()) json_file.emplace(options.json);
  if (format) picture_file.emplace(options.picture);
  const std::string broadphase = options.broadphase.value_or(scene.broadphase.kind);
  if (!options.log.empty()) log_file.emplace(options.log, scene, broadphase);
  std::vector<Onlooker*> onlookers;
  for (const std::string& file : options.record) {
    if (!file.ends_with(".aabbs")) continue;
    boxes.push_back(std::make_unique<AabbsFile>(file));
    onlookers.push_back(boxes.back().get());
  }
  std::optional<CsvFile> table;
  if (!options.csv.empty()) onlookers.push_back(&table.emplace(options.csv));
  Recordings recordings(options);
  if (recordings.look_on()) onlookers.push_back(&recordings);

  StatusLine status;
  const RunResult result = run(scene, broadphase, options.compare, steps, status,
                               log_file ? log_file->wrap() : scenes::Simulation::Wrap{}, extent, onlookers);

  if (log_file) log_file->finish();
  for (const auto& each : boxes) each->finish();
  if (table) table->write(result);
  if (json_file) json_file->stream() << result_json(scene, result);
  if (picture_file) {
    status.say("drawing");
    picture::write_poster(result_poster(scene, result), picture_file->stream(), *format);
  }
  status.say("writing recordings");
  recordings.write(scene, result);
  status.clear();
  if (json_file) json_file->commit();
  if (picture_file) picture_file->commit();
  if (log_file) log_file->commit();
  if (table) table->commit();
  for (const auto& each : boxes) each->commit();
  recordings.commit();
  recordings.say_what_is_left_out();
  for (const WorldRun& world : result.worlds)
    if (const std::string lost = lost_time(world.steps); !lost.empty())
      remark(result.is_comparison() ? world.broadphase + ": " + lost : lost);
  if (options.json != "-" && options.csv != "-") print(result_table(scene, result));

  if (!result.first_difference.empty()) throw std::runtime_error("pairs differ: " + result.first_difference);
  if (const std::string failed = first_failed_check(scene, result); !failed.empty()) throw std::runtime_error(failed);
  for (const WorldRun& world : result.worlds)
    if (!world.simulation->is_finite())
      throw std::runtime_error(fmt::format("the world on {} has coordinates that are not finite", world.broadphase));
  return 0;
}

}  // namespace boxstream::tool
