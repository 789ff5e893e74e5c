// SPDX-License-Identifier: MIT
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_out_of_bounds(const Subject& subject) {
  const WorldSettings& world = subject.scene.world;
  if (world.on_leave == OnLeave::nothing || !has_dynamic(subject)) return std::nullopt;
  return Call{"/world/on_leave", world.on_leave == OnLeave::freeze   ? "freeze"
                                 : world.on_leave == OnLeave::remove ? "remove"
                                                                     : "report"};
}

/// The body stays where it is, for others to run into. Without a mass Bullet takes it for a static one, which neither
/// the solver nor an effect moves.
void freeze(btRigidBody& body) {
  body.setLinearVelocity(btVector3(0, 0, 0));
  body.setAngularVelocity(btVector3(0, 0, 0));
  body.setMassProps(0, btVector3(0, 0, 0));
  body.updateInertiaTensor();
}

void start_out_of_bounds(SceneInstance& instance) {
  const OnLeave what = instance.scene.world.on_leave;
  if (what == OnLeave::nothing) return;
  instance.after_step(out_of_bounds, [&instance, what](double) {
    for (std::size_t i = 0; i < instance.bodies.size(); ++i) {
      btRigidBody& body = *instance.bodies[i];
      if (body.isStaticOrKinematicObject() || !body.isInWorld()) continue;
      if (is_inside(instance.scene.world.bounds, instance.described(i).getOrigin())) continue;
      ++instance.left;
      instance.acting_on(body);
      if (what == OnLeave::freeze) freeze(body);
      if (what == OnLeave::remove) instance.leave(i);
    }
  });
}

std::uint64_t count_outside(const SceneInstance& instance) {
  return instance.left;
}

}  // namespace

const Effect out_of_bounds{"out_of_bounds",
                           "bodies that leave the bounds are frozen, taken out or counted",
                           "a check of each dynamic body after each step",
                           calls_for_out_of_bounds,
                           {.start = start_out_of_bounds},
                           {"bodies outside", count_outside, Effect::Activity::of_run}};

}  // namespace boxstream::effects
