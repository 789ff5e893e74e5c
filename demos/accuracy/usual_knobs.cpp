// SPDX-License-Identifier: MIT
#include "usual_knobs.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "formats/scene_model/expand.hpp"
#include "formats/scene_model/solver_names.hpp"
#include "simulation/effects/linked.hpp"
#include "suits.hpp"

namespace boxstream::accuracy {
namespace {

Knob numbers(const std::string& name, std::set<int> values) {
  Knob knob = parse_knob(name + "=0");
  knob.values.assign(values.begin(), values.end());
  return knob;
}

Knob words(const std::string& name, const std::vector<std::string>& values) {
  Knob knob = parse_knob(name + "=0");
  knob.values.assign(values.begin(), values.end());
  return knob;
}

/// Whether all joints can be those of multibodies, which hold whatever load at whatever step.
bool suits_multibodies(scenes::Scene scene, const scenes::Expanded& expanded) {
  scene.solver.kind = scenes::SolverKind::multibodies;
  const scenes::JointTrees trees = effects::trees_of(scene, expanded);
  return !trees.trees.empty() && trees.refused.empty();
}

}  // namespace

std::vector<Knob> usual_knobs(const scenes::Scene& scene) {
  const scenes::Expanded expanded = scenes::expand(scene);
  std::vector<std::string> kinds{"sequential_impulses"};
  kinds.push_back(suits_matrix(scene, expanded) ? "dantzig" : "nncg");
  if (suits_multibodies(scene, expanded)) kinds.emplace_back("multibodies");
  const std::string own = scenes::solver_names().at(static_cast<std::size_t>(scene.solver.kind));
  if (std::find(kinds.begin(), kinds.end(), own) == kinds.end()) kinds.push_back(own);
  std::vector<Knob> knobs{words("solver", kinds)};
  if (has_bounces(expanded)) knobs.push_back(words("bounces", {"in_solver", "on_contact"}));
  knobs.push_back(numbers("iterations", {scene.solver.iterations, 20, 50}));
  knobs.push_back(numbers("substeps", {scene.time.substeps, 1, 2, 4, 8, 16}));
  return knobs;
}

}  // namespace boxstream::accuracy
