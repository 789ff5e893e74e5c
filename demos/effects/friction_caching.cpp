// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  if (!subject.scene.solver.cache_friction) return std::nullopt;
  return Call{"/solver/cache_friction", "true"};
}

void prepare(const Subject&, WorldRecipe& recipe) {
  recipe.solver.m_solverMode |= SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;
}

}  // namespace

const Effect friction_caching{"friction_caching", "directions of friction are taken over from the step before",
                              "a mode of the solver", called_for, prepare};

}  // namespace boxstream::effects
