// SPDX-License-Identifier: MIT
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_characters(const Subject& subject) {
  return first_of(subject.scene.characters, "/characters", "a character");
}

void prepare_characters(const Subject&, WorldRecipe& recipe) {
  recipe.ghost_pairs = true;
  recipe.collide = true;
}

void start_characters(SceneInstance& instance) {
  instance.walkers.reserve(instance.scene.characters.size());
  for (const Character& character : instance.scene.characters) {
    Walker& walker = instance.walkers.emplace_back(character, instance.scene.world.gravity);
    instance.number(walker.ghost());
    instance.world.world().addCollisionObject(&walker.ghost(), btBroadphaseProxy::CharacterFilter,
                                              btBroadphaseProxy::AllFilter);
    instance.world.world().addAction(&walker.controller());
  }
  if (instance.walkers.empty()) return;
  instance.before_substep(characters, [&instance](double dt) {
    for (Walker& walker : instance.walkers) walker.steer(instance.steps + 1, dt);
  });
  instance.after_substep(characters, [&instance](double dt) {
    for (const Walker& walker : instance.walkers) walker.push(instance, dt);
  });
}

std::uint64_t count_walking(const SceneInstance& instance) {
  return static_cast<std::uint64_t>(std::count_if(instance.walkers.begin(), instance.walkers.end(),
                                                  [](const Walker& walker) { return walker.is_walking(); }));
}

}  // namespace

const Effect characters{"characters",
                        "capsules that walk, climb steps and push",
                        "btGhostPairCallback; a ghost and an action for each",
                        calls_for_characters,
                        {.prepare = prepare_characters, .start = start_characters},
                        {"walking characters", count_walking}};

}  // namespace boxstream::effects
