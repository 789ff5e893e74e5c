// SPDX-License-Identifier: MIT
// Scenes beside the same with a tiny kick, in many directions: how long they stay together, and how fast they part.
#include <algorithm>
#include <cmath>
#include <utility>

#include "accuracy/trajectory.hpp"
#include "experiment_kinds/ensemble.hpp"
#include "experiment_kinds/kinds.hpp"
#include "experiment_kinds/scene_request.hpp"
#include "experiment_kinds/simulated.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/random.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;

constexpr double parted_share = 0.01;    ///< of the scene's size
constexpr std::size_t curve_stride = 3;  ///< steps between points that are drawn

/// A scene, and the same with a kick of one size in as many directions as there are runs.
struct Candidate {
  std::string knobs, setting, broadphase;
  double kick;
  scenes::Scene still;
  std::vector<scenes::Scene> kicked;
  std::string failure{};
  Ensemble ensemble{};
  GrowthRate growth{NAN, NAN, NAN, 0};
};

/// The velocity that is there, and a little more.
json kicked(json document, const std::string& pointer, double kick, scenes::Random& random) {
  json& velocity = document.at(json::json_pointer(pointer));
  const scenes::Vec3 way = random.in_ball(1);
  const double length = std::hypot(way[0], way[1], way[2]);
  for (std::size_t axis = 0; axis < 3; ++axis)
    velocity[axis] = velocity[axis].get<double>() + kick * way[axis] / length;
  return document;
}

/// Where bodies are after each step.
std::vector<accuracy::Frame> run(const scenes::Scene& scene, Candidate& candidate) {
  scenes::Simulation simulation(scene, candidate.broadphase);
  std::vector<accuracy::Frame> frames;
  for (int step = 1; step <= scene.time.steps; ++step) {
    simulation.advance();
    frames.push_back(accuracy::frame_of(simulation));
    if (simulation.is_finite()) continue;
    candidate.failure = "a coordinate is not finite after step " + std::to_string(step);
    break;
  }
  return frames;
}

void follow(Candidate& candidate) {
  const std::vector<accuracy::Frame> still = run(candidate.still, candidate);
  candidate.ensemble.dt = candidate.still.time.dt;
  bool any_differs = false;
  for (const scenes::Scene& scene : candidate.kicked) {
    const std::vector<accuracy::Frame> frames = run(scene, candidate);
    if (!candidate.failure.empty()) return;
    std::vector<double>& distances = candidate.ensemble.distances.emplace_back();
    for (std::size_t step = 0; step < frames.size(); ++step)
      distances.push_back(accuracy::distance(frames[step], still[step]));
    any_differs |= distances.back() > 0;
  }
  if (!any_differs) candidate.failure = "the kick is lost in rounding: all runs are the same";
}

std::vector<Candidate> candidates_of(const json& settings, const accuracy::Request& request,
                                     const std::string& pointer) {
  const json& kicks = settings.at("kicks");
  const auto labels = settings.at("labels").get<std::vector<std::string>>();
  if (labels.size() != kicks.size()) throw std::invalid_argument("not as many labels as kicks");
  const auto parsed = [&](const json& text) { return scenes::parse_scene(text.dump(), request.file); };
  std::vector<Candidate> candidates;
  for (const auto& broadphase : settings.at("broadphases").get<std::vector<std::string>>())
    for (const accuracy::Setting& setting : accuracy::grid(request.knobs))
      for (std::size_t i = 0; i < kicks.size(); ++i) {
        json document = accuracy::with(request.scene, request.knobs, setting);
        if (request.steps != 0) document["time"]["steps"] = request.steps;
        Candidate& candidate = candidates.emplace_back(Candidate{accuracy::label(request.knobs, setting),
                                                                 labels[i],
                                                                 broadphase,
                                                                 kicks[i].get<double>(),
                                                                 parsed(document),
                                                                 {}});
        scenes::Random random(1);
        for (int run = 0; run < settings.at("runs").get<int>(); ++run)
          candidate.kicked.push_back(parsed(kicked(document, pointer, candidate.kick, random)));
      }
  return candidates;
}

std::string series_of(const Candidate& candidate) {
  return candidate.knobs + ", " + candidate.broadphase;
}

/// 1 where the two rates lie apart by more than their intervals, NaN where one of them is not known.
double differs(const GrowthRate& a, const GrowthRate& b) {
  if (std::isnan(a.per_second) || std::isnan(b.per_second)) return NAN;
  return a.low > b.high || b.low > a.high ? 1 : 0;
}

/// The candidate's rate beside that of the one with the same knobs, and this kick and broad-phase.
double differs_from(const Candidate& candidate, const std::vector<Candidate>& all, const std::string& kick,
                    const std::string& broadphase) {
  const auto other = std::find_if(all.begin(), all.end(), [&](const Candidate& one) {
    return one.knobs == candidate.knobs && one.setting == kick && one.broadphase == broadphase;
  });
  return &*other == &candidate ? NAN : differs(candidate.growth, other->growth);
}

Point point_of(const Candidate& candidate, const std::vector<Candidate>& all, double size) {
  Point point{.series = series_of(candidate),
              .setting = candidate.setting,
              .x = candidate.kick,
              .values = std::vector<double>(10, NAN),
              .failure = candidate.failure};
  if (!candidate.failure.empty()) return point;
  const Ensemble& runs = candidate.ensemble;
  const double limit = parted_share * size;
  const auto parted = std::count_if(runs.distances.begin(), runs.distances.end(), [&](const std::vector<double>& run) {
    return *std::max_element(run.begin(), run.end()) > limit;
  });
  point.values = {time_until(runs, limit, 0.1),
                  time_until(runs, limit, 0.5),
                  time_until(runs, limit, 0.9),
                  static_cast<double>(parted) / static_cast<double>(runs.distances.size()),
                  quantile_over_runs(runs, 0.5).back(),
                  candidate.growth.per_second,
                  candidate.growth.low,
                  candidate.growth.high,
                  differs_from(candidate, all, all.front().setting, candidate.broadphase),
                  differs_from(candidate, all, candidate.setting, all.front().broadphase)};
  return point;
}

void add_curves(const std::string& panel, const Candidate& candidate, Results& results) {
  if (!candidate.failure.empty()) return;
  for (const auto& [p, name] : {std::pair(0.1, "10 %"), std::pair(0.5, "50 %"), std::pair(0.9, "90 %")}) {
    Curve curve{panel, series_of(candidate), candidate.setting + ", " + name, {}};
    const std::vector<double> distances = quantile_over_runs(candidate.ensemble, p);
    for (std::size_t step = 0; step < distances.size(); step += curve_stride)
      curve.points.emplace_back(static_cast<double>(step + 1) * candidate.ensemble.dt, distances[step]);
    results.curves.push_back(std::move(curve));
  }
}

void measure_scene(const json& scene, Measurement& measurement) {
  const json& settings = measurement.settings();
  const accuracy::Request request =
      request_of(measurement.experiment, scene.at("file").get<std::string>(), measurement.repeats);
  const std::string panel = request.scene.at("meta").at("name").get<std::string>();
  const auto size = scene.at("size").get<double>();
  std::vector<Candidate> candidates = candidates_of(settings, request, scene.at("kick").get<std::string>());
  const auto announce = [&](const Candidate& candidate, const char* what) {
    measurement.progress(panel + " " + series_of(candidate) + " " + candidate.setting + what);
  };
  const Window window{settings.at("window").at(0).get<double>() * size, parted_share * size};
  for (Candidate& candidate : candidates) {
    announce(candidate, "");
    follow(candidate);
    if (candidate.failure.empty()) candidate.growth = growth_rate(candidate.ensemble, window);
    add_curves(panel, candidate, measurement.results);
  }
  const auto timed = [&](const Candidate& candidate) {
    announce(candidate, ": time");
    scenes::Simulation simulation(candidate.kicked.front(), candidate.broadphase);
    return ms_per_simulated_second(simulation);
  };
  measurement.add_points(panel, candidates, timed, [&](const Candidate& candidate, const auto&) {
    return point_of(candidate, candidates, size);
  });
}

}  // namespace

void measure_predictability(Measurement& measurement) {
  for (const json& scene : measurement.settings().at("scenes")) measure_scene(scene, measurement);
}

}  // namespace boxstream::report
