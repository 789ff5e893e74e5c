// SPDX-License-Identifier: MIT
#include "sweep.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "formats/scene_json/load_scene.hpp"
#include "measure/interleave.hpp"
#include "run_and_sample.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::accuracy {
namespace {

using scenes::Scene;
using scenes::Simulation;

/// The scene of one setting, ready to run.
struct Candidate {
  Row row;
  Scene scene;
};

Scene scene_of(const Request& request, const nlohmann::json& document) {
  const Scene scene = scenes::parse_scene(document.dump(), request.file);
  return request.scale == 1 ? scene : scenes::scaled(scene, request.scale);
}

/// Where all settings start; nothing if that is where the scene's file has bodies.
std::vector<Place> start_of(const Request& request, nlohmann::json document) {
  if (!request.settling) return {};
  document.merge_patch(request.settling->change);
  return places_at_rest(scene_of(request, document), request.broadphase, request.settling->steps);
}

/// The scene with its bodies at their start.
Scene started(const Request& request, const nlohmann::json& document, const std::vector<Place>& start) {
  const Scene scene = scene_of(request, document);
  return start.empty() ? scene : placed(scene, start);
}

bool is_wanted(const Request& request, const Setting& setting) {
  double product = 1;
  for (const nlohmann::json& value : setting) product *= value.is_number() ? value.get<double>() : 1;
  return product <= request.most_product;
}

/// Milliseconds for a simulated second. Building the world is not in it.
double timed(const Request& request, const Candidate& candidate, double seconds) {
  Simulation simulation(candidate.scene, request.broadphase);
  const auto clock = candidate.scene.broadphase.threads > 1 ? measure::Clock::wall : measure::Clock::cpu;
  const auto run = [&] {
    for (std::uint64_t step = 0; step < candidate.row.steps; ++step) simulation.advance();
  };
  return measure::time_once(run, clock) / seconds;
}

/// The reference: the same engine with far finer steps.
Trajectory fine_trajectory(const Request& request, Scene scene, std::uint64_t steps) {
  scene.time.substeps = reference_substeps;
  scene.time.steps = static_cast<int>(steps);
  Simulation simulation(scene, request.broadphase);
  Trajectory trajectory;
  record_contacts_within(simulation, trajectory);
  while (simulation.steps_done() < steps) {
    simulation.advance();
    trajectory.frames.push_back(frame_of(simulation));
    record_contacts(simulation, static_cast<double>(simulation.steps_done()) * scene.time.dt, trajectory);
  }
  return trajectory;
}

/// Checks and outputs would cost time, and speak of the scene as it is.
nlohmann::json bare(nlohmann::json document) {
  for (const char* key : {"checks", "outputs", "expect"}) document.erase(key);
  return document;
}

/// Of a run with any setting.
double seconds_of(const Request& request, const Scene& plain) {
  const auto steps = request.steps == 0 ? static_cast<std::uint64_t>(plain.time.steps) : request.steps;
  return static_cast<double>(steps) * plain.time.dt;
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

Scene scene_with(const Request& request, const Setting& setting) {
  const nlohmann::json document = bare(request.scene);
  Scene scene = started(request, with(document, request.knobs, setting), start_of(request, document));
  const double seconds = seconds_of(request, scene_of(request, document));
  scene.time.steps = static_cast<int>(steps_in(seconds, scene, label(request.knobs, setting), false));
  return scene;
}

Sweep run(const Request& request, const Progress& progress) {
  const nlohmann::json document = bare(request.scene);
  const std::vector<Place> start = start_of(request, document);
  const Scene plain = started(request, document, start);
  Sweep sweep;
  sweep.scene = plain.meta;
  sweep.seconds = seconds_of(request, plain);
  const bool by_place = std::any_of(request.measures.begin(), request.measures.end(), needs_reference);

  std::vector<Candidate> candidates;
  for (const Setting& setting : grid(request.knobs)) {
    if (!is_wanted(request, setting)) continue;
    Candidate candidate;
    candidate.row.setting = setting;
    candidate.row.label = label(request.knobs, setting);
    candidate.scene = started(request, with(document, request.knobs, setting), start);
    candidate.row.steps = steps_in(sweep.seconds, candidate.scene, candidate.row.label, by_place);
    // The plan of a world depends on how long it runs.
    candidate.scene.time.steps = static_cast<int>(candidate.row.steps);
    if (!sweep.own && is_own(document, plain, request.knobs, setting)) sweep.own = candidates.size();
    candidates.push_back(std::move(candidate));
  }

  const std::size_t timed_runs = static_cast<std::size_t>(request.repeats) * (candidates.size() + 1);
  const std::size_t all = candidates.size() + timed_runs + (by_place ? 1 : 0);
  std::size_t done = 0;
  Reference reference{{}, plain.time.dt};
  if (by_place) {
    progress(done++, all, "reference");
    const std::uint64_t steps = steps_in(sweep.seconds, plain, "reference", true);
    reference.trajectory = request.reference ? request.reference(plain, steps) : fine_trajectory(request, plain, steps);
  }
  for (Candidate& candidate : candidates) {
    progress(done++, all, candidate.row.label);
    run_and_sample(request, candidate.scene, reference, candidate.row);
  }

  const measure::Costs costs = measure::interleave_with_control(
      candidates.size(), request.repeats, [&](std::size_t i) { return timed(request, candidates[i], sweep.seconds); },
      [&](std::size_t i) { progress(done++, all, candidates[i].row.label); });
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].row.ms = costs.of[i];
    sweep.rows.push_back(std::move(candidates[i].row));
  }
  sweep.control_spread = costs.control_spread;
  return sweep;
}

}  // namespace boxstream::accuracy
