// SPDX-License-Identifier: MIT
#include "sampling.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "formats/scene_model/expand.hpp"
#include "formats/scene_model/names.hpp"
#include "measure/stopwatch.hpp"
#include "simulation/run/simulation.hpp"
#include "usual_knobs.hpp"

namespace boxstream::accuracy {
namespace {

using scenes::Scene;
using scenes::SolverKind;

constexpr int iterations_of_reference = 100;
/// Share of a budget that goes into the reference.
constexpr double share_of_budget = 0.4;
constexpr int runs_of_sequence = 3;

/// With solvers that do not limit it.
Scene unlimited(Scene scene) {
  scene.solver.iterations = std::max(scene.solver.iterations, iterations_of_reference);
  const scenes::Expanded expanded = scenes::expand(scene);
  if (scene.solver.kind == SolverKind::sequential_impulses && suits_matrix(scene, expanded))
    scene.solver.kind = SolverKind::dantzig;
  if (has_bounces(expanded)) scene.solver.bounces = scenes::Bounces::on_contact;
  return scene;
}

/// Seconds that a substep takes, from a few steps.
double seconds_of_substep(const Request& request, const Scene& scene, std::uint64_t steps) {
  scenes::Simulation simulation(here(scene), request.broadphase);
  const measure::Elapsed elapsed;
  while (simulation.steps_done() < steps && elapsed.seconds() < 0.02 * std::min(request.budget, 50.0))
    simulation.advance();
  return elapsed.seconds() /
         static_cast<double>(simulation.steps_done() * static_cast<std::uint64_t>(scene.time.substeps));
}

/// Of the last run: what time allows, and at least four times what settings have; twice, where they are sought and only
/// have to be sound. 0: even that takes too long.
int finest_substeps(const Request& request, const Scene& scene, std::uint64_t steps, double finest, bool needed) {
  const int least = static_cast<int>(std::ceil(finest)) * (request.seek ? 2 : 4);
  int substeps = std::max(least, reference_substeps);
  if (!std::isfinite(request.budget)) return substeps;
  // All runs together take almost twice as long as the last.
  const double seconds = 1.75 * seconds_of_substep(request, scene, steps) * static_cast<double>(steps);
  const double budget = share_of_budget * request.budget;
  while (substeps / 2 >= least && substeps * seconds > budget) substeps /= 2;
  return needed || substeps * seconds <= budget ? substeps : 0;
}

std::string name_of(const Scene& scene) {
  std::string name =
      std::to_string(scene.time.substeps) + " substeps of " + std::to_string(scene.solver.iterations) + " iterations";
  if (scene.solver.kind != SolverKind::sequential_impulses)
    name += ", " + scenes::solver_names().at(static_cast<std::size_t>(scene.solver.kind));
  if (scene.solver.bounces == scenes::Bounces::on_contact) name += ", bounces on contact";
  if (scene.solver.precision == scenes::Precision::doubled) name += ", double precision";
  return name;
}

/// As far as the request did not say stop; empty if there are not two that are finer than settings, which have `coarse`
/// substeps.
std::vector<Member> sequence_of(const Request& request, Scene scene, const std::optional<Source>& source,
                                double most_seconds, std::uint64_t steps, int finest, double coarse,
                                const std::function<void(const std::string&)>& on_run) {
  std::vector<Member> sequence;
  for (int i = runs_of_sequence - 1; i >= 0; --i) {
    scene.time.substeps = finest >> i;
    if (scene.time.substeps < 1) continue;
    on_run("reference, " + std::to_string(scene.time.substeps) + " substeps");
    Member& member = sequence.emplace_back();
    member.substeps = scene.time.substeps;
    Row row;
    row.steps = steps;
    const bool is_done = is_for_elsewhere(scene)
                             ? sample_elsewhere(request, *source, scene, {}, row, &member.trajectory, most_seconds)
                             : run_and_sample(request, scene, {}, row, &member.trajectory);
    if (!is_done) {
      sequence.pop_back();
      if (sequence.size() < 2 || sequence.back().substeps <= coarse) return {};
      break;
    }
    member.series = row.series;
    member.vitals = row.vitals;
    member.failure = row.failure;
  }
  return sequence;
}

/// Whether there is nothing wrong with it but for checks of the scene.
bool breaks_checks_alone(const std::vector<Member>& sequence) {
  Member last = sequence.back();
  last.vitals.failed_checks.clear();
  return unsound(last.vitals).empty() &&
         std::all_of(sequence.begin(), sequence.end(), [](const Member& member) { return member.failure.empty(); });
}

std::string failure_of(const std::vector<Member>& sequence) {
  for (const Member& member : sequence)
    if (!member.failure.empty()) return member.failure;
  return unsound(sequence.back().vitals);
}

}  // namespace

/// A request that stops after a while.
Request within(const Request& request, double seconds) {
  Request bounded = request;
  if (std::isfinite(seconds))
    bounded.stop = [stop = request.stop, seconds, elapsed = measure::Elapsed()] {
      return (stop && stop()) || elapsed.seconds() > seconds;
    };
  return bounded;
}

Reference run_reference(const Request& request, Scene scene, const std::optional<Source>& source, std::uint64_t steps,
                        double finest, bool needed, const std::function<void(const std::string&)>& on_run) {
  scene.time.steps = static_cast<int>(steps);
  // Where any setting is in the other precision, the finer of both is.
  scene.solver.precision = source ? scenes::Precision::doubled : scene.solver.precision;
  const Scene candidates[] = {unlimited(scene), scene};
  Reference reference;
  const double most_seconds = (needed ? 1.5 : share_of_budget) * request.budget;
  const Request bounded = within(request, most_seconds);
  // Checks may speak of the scene's own step: where finer and finer steps agree, they are right all the same.
  std::optional<Reference> beyond_checks;
  for (Scene candidate : candidates) {
    candidate.solver.iterations = std::max(candidate.solver.iterations, iterations_of_reference);
    // Exact solvers take longer: where there is no time for them, those that iterate do.
    const int substeps = finest_substeps(request, candidate, steps, finest, needed);
    const std::vector<Member> sequence =
        substeps == 0 ? std::vector<Member>()
                      : sequence_of(bounded, candidate, source, most_seconds, steps, substeps, finest, on_run);
    if (sequence.empty()) {
      if (reference.failure.empty()) reference.failure = takes_too_long;
      continue;
    }
    candidate.time.substeps = sequence.back().substeps;
    const std::string failure = failure_of(sequence);
    if (failure.empty() || breaks_checks_alone(sequence)) {
      Reference found = estimated(sequence, request.measures, scene.time.dt);
      found.name = name_of(candidate);
      if (failure.empty()) return found;
      found.remark = "it " + failure + ", which speaks of the scene's own step: finer steps agree on something else";
      if (std::isinf(found.holds) && !beyond_checks) beyond_checks = std::move(found);
    }
    reference.failure = name_of(candidate) + ": " + failure;
    if (name_of(candidates[0]) == name_of(candidates[1])) break;
  }
  return beyond_checks ? *beyond_checks : reference;
}

}  // namespace boxstream::accuracy
