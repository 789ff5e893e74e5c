// SPDX-License-Identifier: MIT
#include <numbers>

#include "effects/effects.hpp"
#include "effects/stage.hpp"
#include "engine/convert.hpp"
#include "engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  if (!subject.scene.world.tumbling) return std::nullopt;
  return Call{"/world/gravity/script", "tumble"};
}

void prepare(const Subject&, WorldRecipe& recipe) {
  recipe.apply_gravity = true;
}

void start(Stage& stage) {
  if (!stage.scene.world.tumbling) return;
  const TumblingGravity script = *stage.scene.world.tumbling;
  const double speed = script.degrees_per_second * std::numbers::pi / 180;
  const btScalar strength = real(script.strength);
  btVector3 axis(0, 1, 0), pull(1, 0, 0);
  stage.before_substep(tumbling_gravity, [&stage, speed, strength, axis, pull](double dt) mutable {
    axis = axis.rotate(btVector3(0, 0, 1), real(speed * dt)).normalized();
    pull = pull.rotate(axis, real(speed * dt)).normalized();
    stage.world.world().setGravity(pull * strength);
  });
}

}  // namespace

const Effect tumbling_gravity{"tumbling_gravity",
                              "gravity turns round and round",
                              "a hook before each substep that calls setGravity",
                              called_for,
                              prepare,
                              nullptr,
                              start};

}  // namespace boxstream::effects
