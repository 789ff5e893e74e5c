// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  if (!subject.scene.broadphase.force_boxes) return std::nullopt;
  return Call{"/broadphase/force_boxes", "true"};
}

void prepare(const Subject&, WorldRecipe& recipe) {
  recipe.force_boxes = true;
}

}  // namespace

const Effect forced_boxes{"forced_boxes", "boxes of sleeping bodies are set again in each step",
                          "setForceUpdateAllAabbs", called_for, prepare};

}  // namespace boxstream::effects
