// SPDX-License-Identifier: MIT
#include "sweep.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "simulation/simulation.hpp"
#include "stopwatch.hpp"
#include "turns.hpp"

namespace boxstream::accuracy {
namespace {

using scenes::Check;
using scenes::Scene;
using scenes::Simulation;
using Places = std::vector<btVector3>;

/// The scene of one setting, ready to run.
struct Candidate {
  Row row;
  Scene scene;
};

Scene scene_of(const Request& request, const nlohmann::json& document) {
  const Scene scene = scenes::parse_scene(document.dump(), request.file);
  return request.scale == 1 ? scene : scenes::scaled(scene, request.scale);
}

bool is_trajectory(const Measure& measure) {
  return measure.kind == Measure::Kind::trajectory;
}

Places places(const Simulation& simulation) {
  Places all;
  for (const btCollisionObject* object : simulation.objects())
    if (!object->isStaticOrKinematicObject()) all.push_back(object->getWorldTransform().getOrigin());
  return all;
}

double distance(const Places& a, const Places& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += double{(a[i] - b[i]).length2()};
  return a.empty() ? 0 : std::sqrt(sum / static_cast<double>(a.size()));
}

bool smallest_is_worst(const Measure& measure) {
  return measure.metric == Check::Metric::lowest || measure.metric == Check::Metric::finite;
}

Series summed_up(const std::vector<double>& values, bool smallest) {
  Series series;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  series.worst = smallest ? *least : *most;
  series.p95 = quantile(values, smallest ? 0.05 : 0.95);
  for (const double value : values) series.mean += value / static_cast<double>(values.size());
  series.last = values.back();
  return series;
}

/// Worlds take the numbers of checks that they have, so this one has a check of each, which always holds.
Scene watched(const Request& request, Scene scene) {
  for (const Measure& measure : request.measures)
    if (!is_trajectory(measure)) scene.checks.push_back({measure.metric, Check::Op::at_most, HUGE_VAL, 0, false});
  return scene;
}

/// A run that is looked at after each step.
void look(const Request& request, Candidate& candidate, const Places& reference) {
  Simulation simulation(watched(request, candidate.scene), request.broadphase);
  std::vector<std::vector<double>> values(request.measures.size());
  Row& row = candidate.row;
  for (std::uint64_t step = 0; step < row.steps && row.failure.empty(); ++step) {
    simulation.advance();
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!is_trajectory(request.measures[i])) values[i].push_back(simulation.metric(request.measures[i].metric));
    if (!simulation.is_finite()) row.failure = "a coordinate is not finite after step " + std::to_string(step + 1);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_trajectory(request.measures[i])) values[i].push_back(distance(places(simulation), reference));
    row.series.push_back(summed_up(values[i], smallest_is_worst(request.measures[i])));
  }
}

/// Milliseconds for a simulated second. Building the world is not in it.
double timed(const Request& request, const Candidate& candidate, double seconds) {
  Simulation simulation(candidate.scene, request.broadphase);
  const Clock clock = candidate.scene.broadphase.threads > 1 ? Clock::wall : Clock::cpu;
  const auto run = [&] {
    for (std::uint64_t step = 0; step < candidate.row.steps; ++step) simulation.advance();
  };
  return stopwatch(run, clock) / seconds;
}

std::uint64_t steps_in(double seconds, const Scene& scene, const std::string& label, bool exactly) {
  const double steps = seconds / scene.time.dt;
  const double whole = std::max(1.0, std::round(steps));
  if (exactly && std::abs(steps - whole) > 1e-6 * whole)
    throw BadKnob(label + ": the " + std::to_string(seconds) +
                  " s of a run are no whole number of its steps, so places at the end cannot be compared");
  return static_cast<std::uint64_t>(whole);
}

}  // namespace

Measure parse_measure(const std::string& name) {
  if (name == "trajectory") return {name, Measure::Kind::trajectory, {}};
  const std::vector<std::string>& names = scenes::metric_names();
  const auto found = std::find(names.begin(), names.end(), name == "penetration" ? "max_penetration" : name);
  if (found == names.end()) {
    std::string known = "penetration, trajectory";
    for (const std::string& other : names) known += ", " + other;
    throw BadKnob(name + ": no metric of this name; there are " + known);
  }
  return {name, Measure::Kind::metric, static_cast<Check::Metric>(found - names.begin())};
}

Sweep run(const Request& request, const Progress& progress) {
  nlohmann::json document = request.scene;
  // Checks and outputs would cost time, and speak of the scene as it is.
  for (const char* key : {"checks", "outputs", "expect"}) document.erase(key);
  const Scene plain = scene_of(request, document);
  Sweep sweep;
  sweep.scene = plain.meta;
  sweep.seconds =
      static_cast<double>(request.steps == 0 ? static_cast<std::uint64_t>(plain.time.steps) : request.steps) *
      plain.time.dt;
  const bool by_place = std::any_of(request.measures.begin(), request.measures.end(), is_trajectory);

  std::vector<Candidate> candidates;
  for (const Setting& setting : grid(request.knobs)) {
    Candidate candidate;
    candidate.row.setting = setting;
    candidate.row.label = label(request.knobs, setting);
    candidate.scene = scene_of(request, with(document, request.knobs, setting));
    candidate.row.steps = steps_in(sweep.seconds, candidate.scene, candidate.row.label, by_place);
    // The plan of a world depends on how long it runs.
    candidate.scene.time.steps = static_cast<int>(candidate.row.steps);
    candidates.push_back(std::move(candidate));
  }

  const std::size_t timed_runs = static_cast<std::size_t>(request.repeats) * (candidates.size() + 1);
  const std::size_t all = candidates.size() + timed_runs + (by_place ? 1 : 0);
  std::size_t done = 0;
  Places reference;
  if (by_place) {
    progress(done++, all, "reference");
    Scene fine = plain;
    fine.time.substeps = reference_substeps;
    fine.time.steps = static_cast<int>(steps_in(sweep.seconds, plain, "reference", true));
    Simulation simulation(fine, request.broadphase);
    while (simulation.steps_done() < static_cast<std::uint64_t>(fine.time.steps)) simulation.advance();
    reference = places(simulation);
  }
  for (Candidate& candidate : candidates) {
    progress(done++, all, candidate.row.label);
    look(request, candidate, reference);
  }

  const Turns turns = take_turns(candidates.size(), request.repeats, [&](std::size_t i) {
    progress(done++, all, candidates[i].row.label);
    return timed(request, candidates[i], sweep.seconds);
  });
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].row.ms = turns.costs[i];
    sweep.rows.push_back(std::move(candidates[i].row));
  }
  sweep.twin_spread = turns.twin_spread;
  return sweep;
}

}  // namespace boxstream::accuracy
