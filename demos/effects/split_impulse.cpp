// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  if (!subject.scene.solver.split_impulse) return std::nullopt;
  return Call{"/solver/split_impulse", "true"};
}

void prepare(const Subject&, WorldRecipe& recipe) {
  recipe.solver.m_splitImpulse = 1;
}

}  // namespace

const Effect split_impulse{"split_impulse", "deep contacts are taken apart without giving bodies speed",
                           "a second solve of contacts that are deeper than 4 cm", called_for, prepare};

}  // namespace boxstream::effects
