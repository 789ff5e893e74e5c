// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bad_input.hpp"
#include "commands.hpp"
#include "files/output_file.hpp"
#include "near_match.hpp"
#include "print.hpp"
#include "query/run.hpp"
#include "query_poster.hpp"
#include "query_report.hpp"
#include "scene_files.hpp"
#include "status_line.hpp"

namespace boxstream::tool {
namespace {

void check_manager(const std::string& name) {
  const std::vector<std::string>& known = query::manager_names();
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw BadInput(
      fmt::format("unknown manager \"{}\"{}; one of: {}", name, did_you_mean(name, known), fmt::join(known, ", ")));
}

}  // namespace

int query_command(const QueryOptions& options) {
  // Everything the user may have got wrong is found out before the first step.
  const std::string manager = options.manager.empty() ? query::manager_names().front() : options.manager;
  check_manager(manager);
  if (options.compare) check_manager(*options.compare);
  query::QueryScene scene = query::load_query_scene(resolve_scene(options.scene, SceneKind::query).string());
  if (options.scale != 1) scene = query::scaled(scene, options.scale);
  const auto format = picture::picture_format(options.picture);
  if (!options.picture.empty() && !format)
    throw BadInput(fmt::format("{}: a picture is a .png or a .svg file", options.picture));
  std::optional<files::OutputFile> json_file;
  std::optional<files::OutputFile> picture_file;
  if (!options.json.empty()) json_file.emplace(options.json);
  if (format) picture_file.emplace(options.picture);

  StatusLine status;
  const std::uint64_t steps = options.steps.value_or(static_cast<std::uint64_t>(scene.steps));
  status.say("setting up");
  const query::RunResult result = query::run(scene, manager, options.compare, steps,
                                             [&](std::uint64_t done, std::uint64_t objects, std::uint64_t pairs) {
                                               status.step(done, steps, objects, pairs);
                                             });
  if (json_file) json_file->stream() << query_json(scene, result);
  if (picture_file) {
    status.say("drawing");
    picture::write_poster(query_poster(scene, result), picture_file->stream(), *format);
  }
  status.clear();
  if (json_file) json_file->commit();
  if (picture_file) picture_file->commit();
  if (options.json != "-") print(query_table(scene, result));
  if (!result.first_difference.empty()) throw std::runtime_error("answers differ: " + result.first_difference);
  return 0;
}

}  // namespace boxstream::tool
