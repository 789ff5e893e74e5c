// SPDX-License-Identifier: MIT
#include <numbers>

#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

// Gravity that stays, and gravity that turns.
namespace boxstream::effects {
namespace {

using namespace scenes;

bool can_fall(const Subject& subject) {
  return has_dynamic(subject) || !subject.scene.soft_bodies.empty() || !subject.scene.characters.empty();
}

std::optional<Call> calls_for_gravity(const Subject& subject) {
  const WorldSettings& world = subject.scene.world;
  if (world.tumbling || world.gravity == Vec3{} || !can_fall(subject)) return std::nullopt;
  return Call{"/world/gravity",
              fmt::format("[{}, {}, {}] m/s^2", world.gravity[0], world.gravity[1], world.gravity[2])};
}

void prepare_gravity(const Subject& subject, WorldRecipe& recipe) {
  recipe.apply_gravity = true;
  if (!subject.scene.world.tumbling) recipe.gravity = vector(subject.scene.world.gravity);
}

std::optional<Call> calls_for_tumbling(const Subject& subject) {
  if (!subject.scene.world.tumbling || !can_fall(subject)) return std::nullopt;
  return Call{"/world/gravity/script", "tumble"};
}

void prepare_tumbling(const Subject&, WorldRecipe& recipe) {
  recipe.apply_gravity = true;
}

void start_tumbling(SceneInstance& instance) {
  if (!instance.scene.world.tumbling) return;
  const TumblingGravity script = *instance.scene.world.tumbling;
  const double speed = script.degrees_per_second * std::numbers::pi / 180;
  const btScalar strength = real(script.strength);
  btVector3 axis(0, 1, 0), pull(1, 0, 0);
  instance.before_substep(tumbling_gravity, [&instance, speed, strength, axis, pull](double dt) mutable {
    axis = axis.rotate(btVector3(0, 0, 1), real(speed * dt)).normalized();
    pull = pull.rotate(axis, real(speed * dt)).normalized();
    instance.world.set_gravity(pull * strength);
    for (Walker& walker : instance.walkers) walker.controller().setGravity(pull * strength);
  });
}

std::uint64_t count_falling(const SceneInstance& instance) {
  return count_moving(instance, [](const btRigidBody& body) { return !body.getGravity().isZero(); }) +
         instance.soft_bodies.size() + instance.walkers.size();
}

}  // namespace

const Effect gravity{
    "gravity",         "everything falls",           "setGravity, and a force on each body in each substep",
    calls_for_gravity, {.prepare = prepare_gravity}, {"falling bodies", count_falling}};

const Effect tumbling_gravity{"tumbling_gravity",
                              "gravity rotates",
                              "a hook before each substep that calls setGravity",
                              calls_for_tumbling,
                              {.prepare = prepare_tumbling, .start = start_tumbling},
                              {"falling bodies", count_falling}};

}  // namespace boxstream::effects
