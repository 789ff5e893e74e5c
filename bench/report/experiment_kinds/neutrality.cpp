// SPDX-License-Identifier: MIT
// The same scene on several broad-phases, compared bit by bit with boxstream.
#include <algorithm>

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

#include "accuracy/trajectory.hpp"
#include "experiment_kinds/kinds.hpp"
#include "experiment_kinds/simulated.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "pair_orders/exact_pairs.hpp"
#include "simulation/run/pair_check.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;
using scenes::Simulation;

const std::vector<std::string> orders{"as it is", "sorted", "exact and sorted"};

struct Candidate {
  std::string broadphase, order;
  Point point{};
  Curve curve{};

  std::string series() const { return broadphase + " (" + order + ")"; }
};

std::unique_ptr<Simulation> make(const scenes::Scene& scene, const std::string& broadphase, const std::string& order) {
  Simulation::Wrap wrap;
  if (order == orders[2])
    wrap = [](std::unique_ptr<btBroadphaseInterface> inner) -> std::unique_ptr<btBroadphaseInterface> {
      return std::make_unique<ExactPairs>(std::move(inner));
    };
  auto simulation = std::make_unique<Simulation>(scene, broadphase, wrap);
  simulation->world().getDispatchInfo().m_deterministicOverlappingPairs = order == orders[1];
  return simulation;
}

/// Runs the scene beside the same one on boxstream with pairs in the same order.
void compare(const scenes::Scene& scene, Candidate& candidate) {
  const auto run = make(scene, candidate.broadphase, candidate.order),
             reference = make(scene, "boxstream", candidate.order);
  double missed = 0, extra = 0;
  run->set_after_pairs([&] {
    const std::vector<Pair> expected = scenes::expected_pairs(*run), held = scenes::held_pairs(*run);
    missed += static_cast<double>(scenes::count_missing(expected, held));
    extra += static_cast<double>(scenes::count_missing(held, expected));
  });
  double first_difference = 0;
  candidate.curve = {scene.meta.name, candidate.series(), candidate.order, {}};
  for (int step = 1; step <= scene.time.steps; ++step) {
    run->advance();
    reference->advance();
    if (first_difference == 0 && run->state_hash() != reference->state_hash()) first_difference = step;
    candidate.curve.points.emplace_back(step * scene.time.dt,
                                        accuracy::distance(accuracy::frame_of(*run), accuracy::frame_of(*reference)));
  }
  candidate.point = {
      .series = candidate.series(),
      .setting = candidate.order,
      .values = {first_difference == 0 ? 1.0 : 0.0, first_difference, missed,
                 extra / (scene.time.steps * scene.time.substeps), candidate.curve.points.back().second}};
}

std::vector<Candidate> candidates_of(const json& settings) {
  std::vector<Candidate> candidates;
  for (const auto& order : settings.at("orders").get<std::vector<std::string>>()) {
    if (std::find(orders.begin(), orders.end(), order) == orders.end())
      throw std::invalid_argument("no order \"" + order + "\"");
    for (const auto& broadphase : settings.at("broadphases").get<std::vector<std::string>>())
      candidates.push_back({broadphase, order});
  }
  return candidates;
}

void measure_scene(const std::string& file, Measurement& measurement) {
  scenes::Scene scene = scenes::load_scene(file);
  scene.time.steps = measurement.settings().value("steps", scene.time.steps);
  std::vector<Candidate> candidates = candidates_of(measurement.settings());
  for (Candidate& candidate : candidates) {
    measurement.progress(scene.meta.name + " " + candidate.series());
    compare(scene, candidate);
    measurement.results.curves.push_back(candidate.curve);
  }
  const auto timed = [&](const Candidate& candidate) {
    measurement.progress(scene.meta.name + " " + candidate.broadphase + ": time");
    return ms_per_simulated_second(*make(scene, candidate.broadphase, candidate.order));
  };
  measurement.add_points(scene.meta.name, candidates, timed,
                         [](const Candidate& candidate, const auto&) { return candidate.point; });
}

}  // namespace

void measure_neutrality(Measurement& measurement) {
  for (const json& file : measurement.settings().at("scenes")) measure_scene(file.get<std::string>(), measurement);
}

}  // namespace boxstream::report
