// SPDX-License-Identifier: MIT
// Scenes with varied settings.
#include <algorithm>
#include <cmath>

#include "experiment_kinds/kinds.hpp"
#include "experiment_kinds/scene_request.hpp"
#include "references/simbody.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;

constexpr std::size_t curve_points = 200;

std::string series_of(const accuracy::Request& request, const accuracy::Row& row) {
  const accuracy::Setting others(row.setting.begin(), row.setting.end() - 1);
  return others.empty() ? request.knobs.back().name : accuracy::label(request.knobs, others);
}

void add_curves(const accuracy::Request& request, const accuracy::Sweep& sweep, const accuracy::Row& row,
                const std::string& metric, Results& results) {
  for (std::size_t m = 0; m < row.values.size(); ++m) {
    if (request.measures[m].name != metric) continue;
    const std::vector<double>& values = row.values[m];
    Curve curve{sweep.scene.name + ": " + metric,
                series_of(request, row),
                accuracy::text_of(request.knobs.back(), row.setting.back()),
                {}};
    const double dt = sweep.seconds / static_cast<double>(row.steps);
    const std::size_t stride = std::max<std::size_t>(1, values.size() / curve_points);
    for (std::size_t i = stride - 1; i < values.size(); i += stride)
      curve.points.emplace_back(dt * static_cast<double>(i + 1), values[i]);
    results.curves.push_back(std::move(curve));
  }
}

/// NaN for what is not measured of this scene.
double value_of(const accuracy::Request& request, const accuracy::Row& row, const std::string& metric) {
  for (std::size_t m = 0; m < row.series.size(); ++m)
    if (request.measures[m].name == metric) return row.series[m].of(request.measures[m]);
  return NAN;
}

void add_points(const Experiment& experiment, const accuracy::Request& request, const accuracy::Sweep& sweep,
                Results& results) {
  for (const accuracy::Row& row : sweep.rows) {
    Point point;
    point.panel = sweep.scene.name;
    point.series = series_of(request, row);
    point.setting = accuracy::text_of(request.knobs.back(), row.setting.back());
    if (const json number = json::parse(point.setting, nullptr, false); number.is_number()) point.x = number;
    point.cost = row.ms;
    point.failure = row.failure;
    for (const std::string& metric : results.metrics) point.values.push_back(value_of(request, row, metric));
    for (std::size_t m = 0; m < row.series.size(); ++m)
      if (accuracy::needs_reference(request.measures[m]) && std::isnan(row.series[m].of(request.measures[m])) &&
          request.reference && !simbody_is_built() && point.failure.empty())
        point.failure = "built without Simbody";
    results.points.push_back(std::move(point));
    for (const json& metric : experiment.settings.value("curves", json::array()))
      add_curves(request, sweep, row, metric.get<std::string>(), results);
  }
  results.controls.push_back({sweep.scene.name, sweep.control_spread});
}

/// A list "panels" has scenes with their own settings, which are merged over the common ones; of the metrics they may
/// name those that apply to them, and a "name", where a scene is measured twice.
std::vector<Experiment> parts_of(const Experiment& experiment) {
  if (!experiment.settings.contains("panels")) return {experiment};
  std::vector<Experiment> parts;
  for (const json& panel : experiment.settings["panels"]) {
    parts.push_back(experiment);
    parts.back().settings.merge_patch(panel);
  }
  return parts;
}

}  // namespace

void measure_scenes(Measurement& measurement) {
  Results& results = measurement.results;
  results.metrics = measurement.settings().at("metrics").get<std::vector<std::string>>();
  for (const Experiment& part : parts_of(measurement.experiment))
    for (const json& scene : part.settings.at("scenes")) {
      const accuracy::Request request = request_of(part, scene.get<std::string>(), measurement.repeats);
      accuracy::Sweep sweep = accuracy::run(request, [&](const accuracy::Stage& stage) {
        measurement.progress(std::to_string(stage.done) + "/" + std::to_string(stage.all) + " " + stage.what);
      });
      sweep.scene.name = part.settings.value("name", sweep.scene.name);
      add_points(part, request, sweep, results);
    }
}

}  // namespace boxstream::report
