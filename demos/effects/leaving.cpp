// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "effects/stage.hpp"
#include "engine/convert.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  const WorldSettings& world = subject.scene.world;
  if (world.on_leave == OnLeave::nothing) return std::nullopt;
  return Call{"/world/on_leave", world.on_leave == OnLeave::freeze   ? "freeze"
                                 : world.on_leave == OnLeave::remove ? "remove"
                                                                     : "report"};
}

/// The body stays where it is, for others to run into.
void freeze(btRigidBody& body) {
  body.setLinearVelocity(btVector3(0, 0, 0));
  body.setAngularVelocity(btVector3(0, 0, 0));
  body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
}

void start(Stage& stage) {
  const OnLeave what = stage.scene.world.on_leave;
  if (what == OnLeave::nothing) return;
  stage.after_step(leaving, [&stage, what](double) {
    for (std::size_t i = 0; i < stage.bodies.size(); ++i) {
      btRigidBody& body = *stage.bodies[i];
      if (body.isStaticOrKinematicObject() || !body.isInWorld()) continue;
      if (is_inside(stage.scene.world.bounds, body.getWorldTransform().getOrigin())) continue;
      ++stage.left;
      if (what == OnLeave::freeze) freeze(body);
      if (what == OnLeave::remove) stage.leave(i);
    }
  });
}

}  // namespace

const Effect leaving{"leaving",
                     "bodies that leave the bounds are frozen, taken out or counted",
                     "a look at each dynamic body after each step",
                     called_for,
                     nullptr,
                     nullptr,
                     start};

}  // namespace boxstream::effects
