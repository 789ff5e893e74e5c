// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "accuracy_report.hpp"
#include "bad_input.hpp"
#include "broadphase_name.hpp"
#include "commands.hpp"
#include "files/output_file.hpp"
#include "print.hpp"
#include "scene/json_text.hpp"
#include "scene_files.hpp"
#include "status_line.hpp"

namespace boxstream::tool {
namespace {

/// A setting that failed has no error that counts.
std::vector<accuracy::Offer> offers(const accuracy::Sweep& sweep, const accuracy::Measure& measure) {
  std::vector<accuracy::Offer> all;
  for (const accuracy::Row& row : sweep.rows)
    all.push_back({row.ms.median, row.failure.empty() ? row.series.front().of(measure) : std::nan("")});
  return all;
}

accuracy::Request request_of(const AccuracyOptions& options) {
  accuracy::Request request;
  request.file = resolve_scene(options.scene, SceneKind::simulation).string();
  request.scene = scenes::parse_json(scenes::read_text_file(request.file), request.file);
  for (const std::string& text : options.knobs) request.knobs.push_back(accuracy::parse_knob(text));
  const std::vector<std::string> usual{"penetration", "energy_drift"};
  for (const std::string& name : options.metrics.empty() ? usual : options.metrics)
    request.measures.push_back(accuracy::parse_measure(name));
  request.broadphase = options.broadphase;
  request.scale = options.scale;
  request.steps = options.steps.value_or(0);
  request.repeats = options.repeats;
  return request;
}

}  // namespace

int accuracy_command(const AccuracyOptions& options) try {
  check_broadphase(options.broadphase);
  AccuracyResult result;
  result.request = request_of(options);
  std::optional<files::OutputFile> csv, json, plot;
  if (!options.csv.empty()) csv.emplace(options.csv);
  if (!options.json.empty()) json.emplace(options.json);
  const auto format = picture::picture_format(options.plot);
  if (!options.plot.empty()) {
    if (!format) throw BadInput(fmt::format("{}: a plot ends in .svg or .png", options.plot));
    plot.emplace(options.plot);
  }

  StatusLine status;
  result.sweep = accuracy::run(result.request, [&](std::size_t done, std::size_t all, const std::string& what) {
    status.say(fmt::format("run {} of {}: {}", done + 1, all, what));
  });
  status.clear();
  result.front = accuracy::front(offers(result.sweep, result.request.measures.front()));

  if (csv) csv->stream() << accuracy_csv(result);
  if (json) json->stream() << accuracy_json(result);
  if (plot) picture::write_plot(accuracy_plot(result), plot->stream(), *format);
  for (std::optional<files::OutputFile>* file : {&csv, &json, &plot})
    if (*file) (*file)->commit();
  if (options.csv != "-" && options.json != "-") print(accuracy_table(result));
  return 0;
} catch (const accuracy::BadKnob& error) {
  throw BadInput(error.what());
}

}  // namespace boxstream::tool
