// SPDX-License-Identifier: MIT
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

// Metrics of pairs are looked at too, though nothing can meet.
void prepare(const Subject&, WorldRecipe& recipe) {
  recipe.collide = true;
}

}  // namespace

const Effect observers{"observers", "metrics of each step, for checks and tables",
                       "a look at bodies, contacts and pairs after each step", called_for, prepare};

}  // namespace boxstream::effects
