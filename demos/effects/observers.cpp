// SPDX-License-Identifier: MIT
#include <algorithm>

#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  if (auto call = first_of(subject.scene.checks, "/checks", "a check")) return call;
  if (!subject.scene.outputs.csv.empty()) return Call{"/outputs/csv", "a table of each step"};
  return std::nullopt;
}

// Pairs may be there though nothing can meet: of bodies that are fixed, with groups of their own.
bool looks_at_pairs(const Scene& scene) {
  return !scene.outputs.csv.empty() || std::any_of(scene.checks.begin(), scene.checks.end(), [](const Check& check) {
    return check.metric == Check::Metric::pairs || check.metric == Check::Metric::missed_pairs;
  });
}

void prepare(const Subject& subject, WorldRecipe& recipe) {
  if (looks_at_pairs(subject.scene)) recipe.collide = true;
}

}  // namespace

const Effect observers{"observers", "metrics of each step, for checks and tables",
                       "a look at bodies, contacts and pairs after each step", called_for, prepare};

}  // namespace boxstream::effects
