// SPDX-License-Identifier: MIT
// Scenes beside the same with a tiny perturbation: how long they stay together.
#include <cmath>

#include "accuracy/trajectory.hpp"
#include "experiment_kinds/kinds.hpp"
#include "experiment_kinds/scene_request.hpp"
#include "experiment_kinds/simulated.hpp"
#include "formats/scene_json/load_scene.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;

constexpr double parted_share = 0.01;  ///< of the scene's size

/// A scene with a perturbed value, and the same one without.
struct Candidate {
  std::string series, setting;
  double perturbation;
  scenes::Scene perturbed, unperturbed;
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
  scenes::Simulation perturbed(candidate.perturbed, "boxstream"), unperturbed(candidate.unperturbed, "boxstream");
  if (perturbed.state_hash() == unperturbed.state_hash()) {
    candidate.failure = "the perturbation is lost in rounding: both runs are the same";
    return;
  }
  for (int step = 1; step <= candidate.perturbed.time.steps; ++step) {
    perturbed.advance();
    unperturbed.advance();
    candidate.distances.emplace_back(
        step * candidate.perturbed.time.dt,
        accuracy::distance(accuracy::frame_of(perturbed), accuracy::frame_of(unperturbed)));
    if (perturbed.is_finite() && unperturbed.is_finite()) continue;
    candidate.failure = "a coordinate is not finite after step " + std::to_string(step);
    return;
  }
}

std::vector<Candidate> candidates_of(const json& settings, const accuracy::Request& request,
                                     const std::string& pointer) {
  const json& kicks = settings.at("kicks");
  const std::vector<std::string> labels = settings.at("labels").get<std::vector<std::string>>();
  if (labels.size() != kicks.size()) throw std::invalid_argument("not as many labels as kicks");
  std::vector<Candidate> candidates;
  for (const accuracy::Setting& setting : accuracy::grid(request.knobs))
    for (std::size_t i = 0; i < kicks.size(); ++i) {
      const json document = accuracy::with(request.scene, request.knobs, setting);
      const double kick = kicks[i].get<double>();
      candidates.push_back({accuracy::label(request.knobs, setting), labels[i], kick,
                            scenes::parse_scene(add(document, pointer, kick).dump(), request.file),
                            scenes::parse_scene(document.dump(), request.file), ""});
      if (request.steps != 0)
        candidates.back().perturbed.time.steps = candidates.back().unperturbed.time.steps =
            static_cast<int>(request.steps);
    }
  return candidates;
}

Point point_of(const Candidate& candidate, double size) {
  Point point{.series = candidate.series,
              .setting = candidate.setting,
              .x = candidate.perturbation,
              .values = {NAN, NAN, NAN},
              .failure = candidate.failure};
  if (!candidate.failure.empty()) return point;
  // Never: as long as the run, marked in the next column.
  point.values = {candidate.distances.back().first, 0, candidate.distances.back().second};
  for (const auto& [time, distance] : candidate.distances)
    if (distance > parted_share * size) {
      point.values[0] = time;
      point.values[1] = 1;
      break;
    }
  return point;
}

void measure_scene(const json& scene, Measurement& measurement) {
  const accuracy::Request request =
      request_of(measurement.experiment, scene.at("file").get<std::string>(), measurement.repeats);
  const std::string panel = request.scene.at("meta").at("name").get<std::string>();
  std::vector<Candidate> candidates =
      candidates_of(measurement.settings(), request, scene.at("kick").get<std::string>());
  const auto announce = [&](const Candidate& candidate, const char* what) {
    measurement.progress(panel + " " + candidate.series + " " + candidate.setting + what);
  };
  for (Candidate& candidate : candidates) {
    announce(candidate, "");
    follow(candidate);
    measurement.results.curves.push_back({panel, candidate.series, candidate.setting, candidate.distances});
  }
  const auto timed = [&](const Candidate& candidate) {
    announce(candidate, ": time");
    scenes::Simulation simulation(candidate.perturbed, "boxstream");
    return ms_per_simulated_second(simulation);
  };
  const auto size = scene.at("size").get<double>();
  measurement.add_points(panel, candidates, timed,
                         [&](const Candidate& candidate, const auto&) { return point_of(candidate, size); });
}

}  // namespace

void measure_predictability(Measurement& measurement) {
  for (const json& scene : measurement.settings().at("scenes")) measure_scene(scene, measurement);
}

}  // namespace boxstream::report
