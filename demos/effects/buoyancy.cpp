// SPDX-License-Identifier: MIT
#include <algorithm>

#include "effects/effects.hpp"
#include "effects/field_tools.hpp"
#include "effects/find.hpp"
#include "engine/convert.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_kind<BuoyancyField>(subject.scene.fields, "/fields", "a fluid");
}

/// Share of a body's bounding box that is below the level.
btScalar share_under(const btRigidBody& body, double level) {
  btVector3 low, high;
  body.getAabb(low, high);
  return std::clamp((real(level) - low.y()) / std::max(high.y() - low.y(), btScalar(1e-6)), btScalar(0), btScalar(1));
}

void start(Stage& stage) {
  for_each_field<BuoyancyField>(stage, [&](const BuoyancyField& field) {
    stage.before_substep(buoyancy, [&stage, field](double dt) {
      for_each_moving(stage, [&](std::size_t i, btRigidBody& body) {
        const btScalar under = share_under(body, field.level);
        if (under == 0) return;
        const btScalar displaced = under * real(field.density * stage.built(i).volume);
        body.applyCentralForce(stage.world.world().getGravity() * -displaced);
        const btScalar rate = under * real(std::min(field.drag, 1 / dt));
        body.applyCentralForce(body.getLinearVelocity() * (-rate / body.getInvMass()));
        body.applyTorque(body.getInvInertiaTensorWorld().inverse() * body.getAngularVelocity() * -rate);
      });
    });
  });
}

}  // namespace

const Effect buoyancy{"buoyancy",
                      "a fluid lifts what is in it",
                      "two forces and a torque on each body in the fluid, before each substep",
                      called_for,
                      nullptr,
                      nullptr,
                      start};

}  // namespace boxstream::effects
