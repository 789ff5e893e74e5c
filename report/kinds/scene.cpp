// SPDX-License-Identifier: MIT
#include <fstream>

#include "accuracy/sweep.hpp"
#include "all.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;

std::string text_of(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

accuracy::Request request_of(const Experiment& experiment, const json& scene, int repeats) {
  const json& settings = experiment.settings;
  accuracy::Request request;
  request.file = scene.get<std::string>();
  std::ifstream stream(request.file);
  request.scene = json::parse(stream);
  for (const auto& [name, values] : settings.at("knobs").items()) {
    std::string text;
    for (const json& value : values) text += (text.empty() ? "" : ",") + text_of(value);
    request.knobs.push_back(accuracy::parse_knob(name + "=" + text));
  }
  for (const json& metric : settings.at("metrics"))
    request.measures.push_back(accuracy::parse_measure(metric.get<std::string>()));
  request.steps = settings.value("steps", std::uint64_t{0});
  request.repeats = repeats;
  return request;
}

void add_points(const accuracy::Request& request, const accuracy::Sweep& sweep, Results& results) {
  for (const accuracy::Row& row : sweep.rows) {
    Point point;
    point.panel = sweep.scene.name;
    const accuracy::Setting others(row.setting.begin(), row.setting.end() - 1);
    point.series = others.empty() ? request.knobs.back().name : accuracy::label(request.knobs, others);
    point.setting = text_of(row.setting.back());
    if (row.setting.back().is_number()) point.x = row.setting.back().get<double>();
    point.cost = row.ms;
    point.failure = row.failure;
    for (const accuracy::Series& series : row.series) point.values.push_back(series.worst);
    results.points.push_back(std::move(point));
  }
  results.twins.push_back({sweep.scene.name, sweep.twin_spread});
}

}  // namespace

Results scene_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress) {
  Results results;
  results.cost_unit = "ms per simulated second";
  try {
    for (const json& metric : experiment.settings.at("metrics")) results.metrics.push_back(metric.get<std::string>());
    for (const json& scene : experiment.settings.at("scenes")) {
      const accuracy::Request request = request_of(experiment, scene, options.repeats);
      const accuracy::Sweep sweep =
          accuracy::run(request, [&](std::size_t done, std::size_t all, const std::string& what) {
            progress(std::to_string(done) + "/" + std::to_string(all) + " " + what);
          });
      add_points(request, sweep, results);
    }
  } catch (const json::exception& error) {
    throw BadExperiment(experiment.file + ": " + error.what());
  } catch (const accuracy::BadKnob& error) {
    throw BadExperiment(experiment.file + ": " + error.what());
  }
  return results;
}

}  // namespace boxstream::report
