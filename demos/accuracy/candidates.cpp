// SPDX-License-Identifier: MIT
#include "candidates.hpp"

#include <algorithm>
#include <cmath>

#include "formats/scene_json/load_scene.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::accuracy {

using scenes::Scene;

namespace {

/// Exact solvers do not iterate, nor do joints of multibodies: of what is sought, one such setting is enough.
bool is_repetition(const Request& request, const Scene& scene, const Scene& plain) {
  using Kind = scenes::SolverKind;
  const bool iterates = scene.solver.kind == Kind::sequential_impulses || scene.solver.kind == Kind::nncg;
  return request.seek && !iterates && scene.solver.iterations != plain.solver.iterations;
}

/// Where settings are sought, knobs that seldom help are turned one at a time, with the last knob alone.
bool is_rare_alone(const Request& request, const Setting& setting, const nlohmann::json& document, const Scene& plain) {
  const auto is_turned = [&](std::size_t k) { return !is_own(document, plain, {request.knobs[k]}, {setting[k]}); };
  std::size_t rare = 0, all = 0;
  for (std::size_t k = 0; k + 1 < setting.size(); ++k)
    if (is_turned(k)) ++all, rare += request.knobs[k].is_rare ? 1 : 0;
  return rare == 0 || all == 1;
}

bool is_wanted(const Request& request, const Setting& setting) {
  double product = 1;
  for (const nlohmann::json& value : setting) product *= value.is_number() ? value.get<double>() : 1;
  return product <= request.most_product;
}

}  // namespace

nlohmann::json bare(nlohmann::json document) {
  for (const char* key : {"outputs", "expect"}) document.erase(key);
  return document;
}

Scene scene_of(const Request& request, const nlohmann::json& document) {
  const Scene scene = scenes::parse_scene(document.dump(), request.file);
  return request.scale == 1 ? scene : scenes::scaled(scene, request.scale);
}

std::vector<Place> start_of(const Request& request, nlohmann::json document) {
  if (!request.settling) return {};
  document.merge_patch(request.settling->change);
  return places_at_rest(here(scene_of(request, document)), request.broadphase, request.settling->steps);
}

Scene started(const Request& request, const nlohmann::json& document, const std::vector<Place>& start) {
  const Scene scene = scene_of(request, document);
  return start.empty() ? scene : placed(scene, start);
}

Candidates candidates_of(const Request& request, const nlohmann::json& document, const Scene& plain,
                         const std::vector<Place>& start) {
  Candidates found;
  for (const Setting& setting : grid(request.knobs)) {
    if (!is_wanted(request, setting)) continue;
    if (request.seek && !is_rare_alone(request, setting, document, plain)) continue;
    Candidate candidate;
    candidate.row.setting = setting;
    candidate.row.label = label(request.knobs, setting);
    const nlohmann::json turned = with(document, request.knobs, setting);
    candidate.scene = started(request, turned, start);
    if (is_for_elsewhere(candidate.scene)) {
      if (!request.elsewhere)
        throw BadKnob(
            "/solver/precision: boxstream-double, the part of this tool that has worlds of double precision, is not "
            "installed; it is built where Bullet is there in both precisions");
      candidate.source = {turned, start};
      found.any_elsewhere = true;
    }
    if (is_repetition(request, candidate.scene, plain)) continue;
    found.finest = std::max(found.finest, fineness(candidate.scene, plain));
    found.cost += fineness(candidate.scene, plain) * cost_of_substep(candidate.scene);
    if (!found.own && is_own(document, plain, request.knobs, setting)) found.own = found.all.size();
    found.all.push_back(std::move(candidate));
  }
  return found;
}

void adapt_checks(const Request& request, const Scene& plain, Scene& scene) {
  const bool whole = (request.steps == 0 || request.steps == static_cast<std::uint64_t>(plain.time.steps)) &&
                     request.scale == 1 && !request.settling;
  std::erase_if(scene.checks, [&](const scenes::Check& check) {
    return !whole || check.metric == scenes::Check::Metric::missed_pairs;
  });
  for (scenes::Check& check : scene.checks)
    check.at = static_cast<std::uint64_t>(std::llround(static_cast<double>(check.at) * plain.time.dt / scene.time.dt));
}

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

double fineness(const Scene& scene, const Scene& plain) {
  return static_cast<double>(scene.time.substeps) * plain.time.dt / scene.time.dt;
}

double work_of(const Candidate& candidate) {
  return static_cast<double>(candidate.row.steps) * candidate.scene.time.substeps;
}

double cost_of_substep(const Scene& scene) {
  const bool iterates =
      scene.solver.kind == scenes::SolverKind::sequential_impulses || scene.solver.kind == scenes::SolverKind::nncg;
  const double of_numbers = scene.solver.precision == scenes::Precision::doubled ? 1.3 : 1;
  return of_numbers * (1 + (iterates ? 0.03 * scene.solver.iterations : 0.5));
}

double expected_cost(const Candidate& candidate) {
  return work_of(candidate) * cost_of_substep(candidate.scene);
}

}  // namespace boxstream::accuracy
