// SPDX-License-Identifier: MIT
#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

/// A surface carries by friction alone.
bool is_conveyor(const Body& body) {
  return body.surface_velocity != Vec3{} && body.traits.material.friction > 0;
}

std::optional<Call> calls_for_conveyors(const Subject& subject) {
  return first_meeting(
      subject, is_conveyor, [](const Body& body) { return is_dynamic(body) && body.traits.material.friction > 0; },
      [](const Body& body) {
        const Vec3& v = body.surface_velocity;
        return fmt::format("a surface that moves with [{}, {}, {}] m/s", v[0], v[1], v[2]);
      });
}

/// Kinematic to Bullet, so that its solver has a body of it, and what lies on it stays awake. Fixed where no belt
/// carries anything: smooth bodies may sleep.
void configure_conveyor(const Subject& subject, const Body& description, btRigidBody& body) {
  if (!is_conveyor(description) || !calls_for_conveyors(subject)) return;
  body.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  body.forceActivationState(DISABLE_DEACTIVATION);
}

void start_conveyors(SceneInstance& instance) {
  for (std::size_t i = 0; i < instance.bodies.size(); ++i) {
    btRigidBody& body = *instance.bodies[i];
    if (const Body& description = instance.expanded.bodies[i]; is_conveyor(description))
      instance.world.solver().set_surface_velocity(
          body, instance.described(i).getBasis() * vector(description.surface_velocity));
  }
}

}  // namespace

const Effect conveyors{"conveyors",
                       "surfaces carry along what lies on them",
                       "a velocity of the solver's body while rows of its contacts are made",
                       calls_for_conveyors,
                       {.configure_body = configure_conveyor, .start = start_conveyors},
                       {"contact points", count_rows<&SolverRows::carried>, Effect::Activity::of_run}};

}  // namespace boxstream::effects
