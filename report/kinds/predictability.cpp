// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "accuracy/stopwatch.hpp"
#include "accuracy/track.hpp"
#include "accuracy/turns.hpp"
#include "all.hpp"
#include "scene/scene_error.hpp"
#include "scene_request.hpp"
#include "simulation/simulation.hpp"
#include "understood.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;

constexpr double parted_share = 0.01;  ///< of the scene's size

/// A scene with a kick, and the same one without.
struct Candidate {
  std::string series, setting;
  double kick;
  scenes::Scene kicked, still;
  std::string failure;
  std::vector<std::pair<double, double>> distances{};  ///< over time
};

/// The value that is there, and a little more.
json add(json document, const std::string& pointer, double kick) {
  json& place = document.at(json::json_pointer(pointer));
  place = place.get<double>() + kick;
  return document;
}

void follow(Candidate& candidate) {
  scenes::Simulation kicked(candidate.kicked, "boxstream"), still(candidate.still, "boxstream");
  if (kicked.state_hash() == still.state_hash()) {
    candidate.failure = "the kick is lost in rounding: both runs are the same";
    return;
  }
  for (int step = 1; step <= candidate.kicked.time.steps; ++step) {
    kicked.advance();
    still.advance();
    candidate.distances.emplace_back(step * candidate.kicked.time.dt,
                                     accuracy::distance(accuracy::frame_of(kicked), accuracy::frame_of(still)));
    if (kicked.is_finite() && still.is_finite()) continue;
    candidate.failure = "a coordinate is not finite after step " + std::to_string(step);
    return;
  }
}

double timed(const Candidate& candidate) {
  scenes::Simulation simulation(candidate.kicked, "boxstream");
  const auto run = [&] {
    for (int step = 0; step < candidate.kicked.time.steps; ++step) simulation.advance();
  };
  return accuracy::stopwatch(run) / (candidate.kicked.time.steps * candidate.kicked.time.dt);
}

std::vector<Candidate> candidates_of(const Experiment& experiment, const accuracy::Request& request,
                                     const std::string& pointer) {
  const json& kicks = experiment.settings.at("kicks");
  const std::vector<std::string> labels = experiment.settings.at("labels").get<std::vector<std::string>>();
  if (labels.size() != kicks.size()) throw BadExperiment(experiment.file + ": not as many labels as kicks");
  std::vector<Candidate> candidates;
  for (const accuracy::Setting& setting : accuracy::grid(request.knobs))
    for (std::size_t i = 0; i < kicks.size(); ++i) {
      const json document = accuracy::with(request.scene, request.knobs, setting);
      const double kick = kicks[i].get<double>();
      candidates.push_back({accuracy::label(request.knobs, setting), labels[i], kick,
                            scenes::parse_scene(add(document, pointer, kick).dump(), request.file),
                            scenes::parse_scene(document.dump(), request.file), ""});
      if (request.steps != 0)
        candidates.back().kicked.time.steps = candidates.back().still.time.steps = static_cast<int>(request.steps);
    }
  return candidates;
}

void add_point(const Candidate& candidate, const std::string& panel, double size, const accuracy::Estimate& cost,
               Results& results) {
  Point point;
  point.panel = panel;
  point.series = candidate.series;
  point.setting = candidate.setting;
  point.x = candidate.kick;
  point.cost = cost;
  point.failure = candidate.failure;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  point.values = {nan, nan, nan};
  if (candidate.failure.empty()) {
    // Never: as long as the run, marked in the next column.
    point.values = {candidate.distances.back().first, 0, candidate.distances.back().second};
    for (const auto& [time, distance] : candidate.distances)
      if (distance > parted_share * size) {
        point.values[0] = time;
        point.values[1] = 1;
        break;
      }
  }
  results.points.push_back(std::move(point));
  results.curves.push_back({panel, candidate.series, candidate.setting, candidate.distances});
}

}  // namespace

Results predictability_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress) {
  Results results;
  results.cost_unit = "ms per simulated second";
  results.metrics = {"parts_after_s", "parted", "distance_at_end_m"};
  return with_settings_of(experiment, [&](const nlohmann::json&) {
    for (const json& scene : experiment.settings.at("scenes")) {
      const accuracy::Request request = request_of(experiment, scene.at("file").get<std::string>(), options.repeats);
      const std::string panel = request.scene.at("meta").at("name").get<std::string>();
      std::vector<Candidate> candidates = candidates_of(experiment, request, scene.at("kick").get<std::string>());
      for (Candidate& candidate : candidates) {
        progress(panel + " " + candidate.series + " " + candidate.setting);
        follow(candidate);
      }
      const accuracy::Turns turns = accuracy::take_turns(candidates.size(), options.repeats, [&](std::size_t i) {
        progress(panel + " " + candidates[i].series + " " + candidates[i].setting + ": time");
        return timed(candidates[i]);
      });
      for (std::size_t i = 0; i < candidates.size(); ++i)
        add_point(candidates[i], panel, scene.at("size").get<double>(), turns.costs[i], results);
      results.twins.push_back({panel, turns.twin_spread});
    }
    return results;
  });
}

}  // namespace boxstream::report
