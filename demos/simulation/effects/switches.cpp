// SPDX-License-Identifier: MIT
#include "simulation/effects/effects.hpp"
#include "simulation/engine/world_recipe.hpp"

// What a scene switches on with one word.
namespace boxstream::effects {
namespace {

using scenes::WorldRecipe;

std::optional<Call> if_on(bool on, const char* pointer) {
  return on ? std::optional(Call{pointer, "true"}) : std::nullopt;
}

}  // namespace

const Effect split_impulse{
    "split_impulse",
    "deep contacts are separated without giving bodies speed",
    "a second solve of contacts that are deeper than 4 cm",
    [](const Subject& subject) { return if_on(subject.scene.solver.split_impulse, "/solver/split_impulse"); },
    {.prepare = [](const Subject&, WorldRecipe& recipe) { recipe.solver.m_splitImpulse = 1; }}};

const Effect friction_caching{
    "friction_caching",
    "directions of friction are taken over from the step before",
    "a mode of the solver",
    [](const Subject& subject) { return if_on(subject.scene.solver.cache_friction, "/solver/cache_friction"); },
    {.prepare = [](const Subject&, WorldRecipe& recipe) {
      recipe.solver.m_solverMode |= SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;
    }}};

const Effect forced_boxes{
    "forced_boxes",
    "boxes of sleeping bodies are set again in each step",
    "setForceUpdateAllAabbs",
    [](const Subject& subject) { return if_on(subject.scene.broadphase.force_boxes, "/broadphase/force_boxes"); },
    {.prepare = [](const Subject&, WorldRecipe& recipe) { recipe.force_boxes = true; }}};

}  // namespace boxstream::effects
