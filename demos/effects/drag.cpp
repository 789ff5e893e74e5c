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
  return first_kind<DragField>(subject.scene.fields, "/fields", "drag");
}

void start(Stage& stage) {
  for_each_field<DragField>(stage, [&](const DragField& field) {
    stage.before_substep(drag, [&stage, field](double dt) {
      for_each_moving(stage, [&](std::size_t, btRigidBody& body) {
        const btVector3 v = body.getLinearVelocity();
        const double strength = field.linear + field.quadratic * v.length();
        body.applyCentralForce(v * -real(std::min(strength, most_strength(body, dt))));
        if (field.angular == 0) return;
        const btVector3& inverse = body.getInvInertiaDiagLocal();
        const double most = 1 / (double{inverse[inverse.maxAxis()]} * dt);
        body.applyTorque(body.getAngularVelocity() * -real(std::min(field.angular, most)));
      });
    });
  });
}

}  // namespace

const Effect drag{"drag",
                  "a fluid that is everywhere slows bodies down",
                  "a force on each dynamic body before each substep",
                  called_for,
                  nullptr,
                  nullptr,
                  start};

}  // namespace boxstream::effects
