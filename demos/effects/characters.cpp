// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "effects/stage.hpp"
#include "engine/convert.hpp"
#include "engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_of(subject.scene.characters, "/characters", "a character");
}

void prepare(const Subject&, WorldRecipe& recipe) {
  recipe.ghost_pairs = true;
  recipe.collide = true;
}

void start(Stage& stage) {
  stage.walkers.reserve(stage.scene.characters.size());
  for (const Character& character : stage.scene.characters) {
    Walker& walker = stage.walkers.emplace_back(character, stage.scene.world.gravity);
    stage.number(walker.ghost());
    stage.world.world().addCollisionObject(&walker.ghost(), btBroadphaseProxy::CharacterFilter,
                                           btBroadphaseProxy::AllFilter);
    stage.world.world().addAction(&walker.controller());
  }
  if (stage.walkers.empty()) return;
  stage.before_substep(characters, [&stage](double dt) {
    for (Walker& walker : stage.walkers) walker.steer(stage.steps + 1, dt);
  });
  stage.after_substep(characters, [&stage](double dt) {
    for (const Walker& walker : stage.walkers) walker.push(stage.world.dispatcher(), stage.objects, dt);
  });
}

}  // namespace

const Effect characters{"characters",
                        "capsules that walk, climb steps and push",
                        "btGhostPairCallback; a ghost and an action for each",
                        called_for,
                        prepare,
                        nullptr,
                        start};

}  // namespace boxstream::effects
