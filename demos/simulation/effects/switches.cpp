// SPDX-License-Identifier: MIT
#include "simulation/effects/effects.hpp"
#include "simulation/engine/world_recipe.hpp"

// What a scene switches on with one word.
namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> if_on(bool on, const char* pointer) {
  return on ? std::optional(Call{pointer, "true"}) : std::nullopt;
}

std::optional<Call> calls_for_split_impulse(const Subject& subject) {
  return if_on(subject.scene.solver.split_impulse, "/solver/split_impulse");
}
void prepare_split_impulse(const Subject&, WorldRecipe& recipe) {
  recipe.solver.m_splitImpulse = 1;
}

std::optional<Call> calls_for_friction_caching(const Subject& subject) {
  return if_on(subject.scene.solver.cache_friction, "/solver/cache_friction");
}
void prepare_friction_caching(const Subject&, WorldRecipe& recipe) {
  recipe.solver.m_solverMode |= SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;
}

std::optional<Call> calls_for_forced_boxes(const Subject& subject) {
  return if_on(subject.scene.broadphase.force_boxes, "/broadphase/force_boxes");
}
void prepare_forced_boxes(const Subject&, WorldRecipe& recipe) {
  recipe.force_boxes = true;
}

}  // namespace

const Effect split_impulse{"split_impulse",
                           "deep contacts are taken apart without giving bodies speed",
                           "a second solve of contacts that are deeper than 4 cm",
                           calls_for_split_impulse,
                           {.prepare = prepare_split_impulse}};

const Effect friction_caching{"friction_caching",
                              "directions of friction are taken over from the step before",
                              "a mode of the solver",
                              calls_for_friction_caching,
                              {.prepare = prepare_friction_caching}};

const Effect forced_boxes{"forced_boxes",
                          "boxes of sleeping bodies are set again in each step",
                          "setForceUpdateAllAabbs",
                          calls_for_forced_boxes,
                          {.prepare = prepare_forced_boxes}};

}  // namespace boxstream::effects
