// SPDX-License-Identifier: MIT
#include "usual_knobs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include "formats/scene_model/names.hpp"
#include "simulation/effects/linked.hpp"
#include "simulation/effects/tunnelling.hpp"
#include "simulation/engine/bullet_shapes.hpp"
#include "simulation/engine/mass.hpp"

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

/// Whether single precision may be too coarse: a float's spacing at the place of a body is more than 1/400 of its
/// thickness, or the heaviest body weighs a thousand times the lightest.
bool wants_doubles(const scenes::Expanded& expanded) {
  constexpr double most_ratio = 1000, of_thickness = 0.0025;
  const std::vector<double> half = effects::half_thicknesses(expanded.shapes);
  scenes::ShapeSet shapes(expanded.shapes);
  double lightest = std::numeric_limits<double>::infinity(), heaviest = 0;
  for (const scenes::Body& body : expanded.bodies) {
    if (body.traits.type != scenes::BodyType::dynamic) continue;
    const double mass = scenes::mass_of(body, shapes.solid(body.traits.shape)).mass;
    lightest = std::min(lightest, mass);
    heaviest = std::max(heaviest, mass);
    double far = 0;
    for (const double each : body.position) far = std::max(far, std::abs(each));
    const auto rounded = static_cast<float>(far);
    const double apart = double{std::nextafter(rounded, std::numeric_limits<float>::infinity())} - double{rounded};
    if (apart > of_thickness * 2 * half[body.traits.shape]) return true;
  }
  return heaviest >= most_ratio * lightest;
}

/// m: finer than the engine's, where a shape is so thin that it is a large part of it; 0: they do, or the scene has its
/// own.
double finer_margin(const scenes::Expanded& expanded) {
  constexpr double thin = 0.05;
  const std::vector<double> half = effects::half_thicknesses(expanded.shapes);
  double least = thin;
  bool is_asked = false;
  for (std::size_t i = 0; i < expanded.shapes.size(); ++i) {
    const scenes::Shape& shape = expanded.shapes[i];
    if (shape.margin) return 0;
    if (!std::holds_alternative<scenes::BoxShape>(shape.value) &&
        !std::holds_alternative<scenes::CylinderShape>(shape.value))
      continue;
    if (half[i] >= least) continue;
    least = half[i];
    is_asked = true;
  }
  return is_asked ? least / 50 : 0;
}

Knob rare(Knob knob) {
  knob.is_rare = true;
  return knob;
}

}  // namespace

std::vector<Knob> usual_knobs(const scenes::Scene& scene, bool has_doubles) {
  const scenes::Expanded expanded = scenes::expand(scene);
  std::vector<std::string> kinds{"sequential_impulses"};
  kinds.push_back(suits_matrix(scene, expanded) ? "dantzig" : "nncg");
  if (suits_multibodies(scene, expanded)) kinds.emplace_back("multibodies");
  const std::string own = scenes::solver_names().at(static_cast<std::size_t>(scene.solver.kind));
  if (std::find(kinds.begin(), kinds.end(), own) == kinds.end()) kinds.push_back(own);
  std::vector<Knob> knobs{words("solver", kinds)};
  if (has_bounces(expanded)) knobs.push_back(words("bounces", {"in_solver", "on_contact"}));
  if (has_doubles && scene.solver.precision == scenes::Precision::single && wants_doubles(expanded))
    knobs.push_back(rare(words("precision", {"single", "double"})));
  if (const double margin = finer_margin(expanded); margin > 0) {
    Knob knob = rare(parse_knob("margin=0"));
    knob.values = {nullptr, margin};
    knob.labels = {"usual", nlohmann::json(margin).dump()};
    knobs.push_back(std::move(knob));
  }
  // Checks and events of single steps speak of the step as it is.
  if (scene.checks.empty() && scene.time.warmup_steps == 0) {
    Knob knob = rare(parse_knob("step=0"));
    knob.values = {scene.time.dt, scene.time.dt / 2, scene.time.dt / 4};
    knobs.push_back(std::move(knob));
  }
  knobs.push_back(numbers("iterations", {scene.solver.iterations, 20, 50}));
  knobs.push_back(numbers("substeps", {scene.time.substeps, 1, 2, 4, 8, 16}));
  return knobs;
}

}  // namespace boxstream::accuracy
