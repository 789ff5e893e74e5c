// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <fstream>

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

#include "accuracy/stopwatch.hpp"
#include "accuracy/track.hpp"
#include "accuracy/turns.hpp"
#include "all.hpp"
#include "exact_pairs.hpp"
#include "scene/scene_error.hpp"
#include "simulation/pair_check.hpp"
#include "simulation/pair_list.hpp"
#include "simulation/simulation.hpp"
#include "understood.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;
using scenes::Simulation;

const std::vector<std::string> orders{"as it is", "sorted", "exact and sorted"};

struct Candidate {
  std::string broadphase, order;
};

std::unique_ptr<Simulation> make(const scenes::Scene& scene, const Candidate& candidate) {
  Simulation::Wrap wrap;
  if (candidate.order == orders[2])
    wrap = [](std::unique_ptr<btBroadphaseInterface> inner) -> std::unique_ptr<btBroadphaseInterface> {
      return std::make_unique<ExactPairs>(std::move(inner));
    };
  auto simulation = std::make_unique<Simulation>(scene, candidate.broadphase, wrap);
  simulation->world().getDispatchInfo().m_deterministicOverlappingPairs = candidate.order == orders[1];
  return simulation;
}

/// A run beside the one on boxstream with pairs in the same order.
Point compare(const scenes::Scene& scene, const Candidate& candidate, Curve& curve) {
  const auto run = make(scene, candidate), reference = make(scene, {"boxstream", candidate.order});
  double missed = 0, extra = 0;
  run->set_after_pairs([&] {
    const std::vector<Pair> expected = scenes::expected_pairs(*run), held = scenes::held_pairs(*run);
    missed += static_cast<double>(scenes::count_missing(expected, held));
    extra += static_cast<double>(scenes::count_missing(held, expected));
  });
  double first_difference = 0;
  for (int step = 1; step <= scene.time.steps; ++step) {
    run->advance();
    reference->advance();
    if (first_difference == 0 && run->state_hash() != reference->state_hash()) first_difference = step;
    curve.points.emplace_back(step * scene.time.dt,
                              accuracy::distance(accuracy::frame_of(*run), accuracy::frame_of(*reference)));
  }
  Point point;
  point.values = {first_difference == 0 ? 1.0 : 0.0, first_difference, missed,
                  extra / (scene.time.steps * scene.time.substeps), curve.points.back().second};
  return point;
}

double timed(const scenes::Scene& scene, const Candidate& candidate) {
  const auto simulation = make(scene, candidate);
  const auto run = [&] {
    for (int step = 0; step < scene.time.steps; ++step) simulation->advance();
  };
  return accuracy::stopwatch(run) / (scene.time.steps * scene.time.dt);
}

std::vector<Candidate> candidates_of(const Experiment& experiment) {
  std::vector<Candidate> candidates;
  for (const json& order : experiment.settings.at("orders")) {
    if (std::find(orders.begin(), orders.end(), order.get<std::string>()) == orders.end())
      throw BadExperiment(experiment.file + ": no order \"" + order.get<std::string>() + "\"");
    for (const json& broadphase : experiment.settings.at("broadphases"))
      candidates.push_back({broadphase.get<std::string>(), order.get<std::string>()});
  }
  return candidates;
}

}  // namespace

Results neutrality_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress) {
  Results results;
  results.cost_unit = "ms per simulated second";
  results.metrics = {"identical", "first_difference_step", "missed", "extra_per_step", "distance_at_end_m"};
  return with_settings_of(experiment, [&](const nlohmann::json&) {
    const std::vector<Candidate> candidates = candidates_of(experiment);
    for (const json& file : experiment.settings.at("scenes")) {
      scenes::Scene scene = scenes::load_scene(file.get<std::string>());
      scene.time.steps = experiment.settings.value("steps", scene.time.steps);
      const std::size_t first = results.points.size();
      for (const Candidate& candidate : candidates) {
        const std::string series = candidate.broadphase + " (" + candidate.order + ")";
        progress(scene.meta.name + " " + series);
        Curve curve{scene.meta.name, series, candidate.order, {}};
        Point point = compare(scene, candidate, curve);
        point.panel = scene.meta.name;
        point.series = series;
        point.setting = candidate.order;
        results.points.push_back(std::move(point));
        results.curves.push_back(std::move(curve));
      }
      const accuracy::Turns turns = accuracy::take_turns(candidates.size(), options.repeats, [&](std::size_t i) {
        progress(scene.meta.name + " " + candidates[i].broadphase + ": time");
        return timed(scene, candidates[i]);
      });
      for (std::size_t i = 0; i < candidates.size(); ++i) results.points[first + i].cost = turns.costs[i];
      results.twins.push_back({scene.meta.name, turns.twin_spread});
    }
    return results;
  });
}

}  // namespace boxstream::report
