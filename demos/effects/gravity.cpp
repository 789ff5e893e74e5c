// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "engine/convert.hpp"
#include "engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  const WorldSettings& world = subject.scene.world;
  if (world.tumbling || world.gravity == Vec3{}) return std::nullopt;
  return Call{"/world/gravity",
              fmt::format("[{}, {}, {}] m/s^2", world.gravity[0], world.gravity[1], world.gravity[2])};
}

void prepare(const Subject& subject, WorldRecipe& recipe) {
  recipe.apply_gravity = true;
  if (!subject.scene.world.tumbling) recipe.gravity = vector(subject.scene.world.gravity);
}

}  // namespace

const Effect gravity{"gravity", "everything falls", "setGravity, and a force on each body in each substep", called_for,
                     prepare};

}  // namespace boxstream::effects
