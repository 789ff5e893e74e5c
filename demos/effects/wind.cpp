// SPDX-License-Identifier: MIT
#include <numbers>

#include "effects/effects.hpp"
#include "effects/field_tools.hpp"
#include "effects/find.hpp"
#include "engine/convert.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_kind<WindField>(subject.scene.fields, "/fields", "wind");
}

void start(Stage& stage) {
  for_each_field<WindField>(stage, [&](const WindField& field) {
    const btVector3 air = vector(field.velocity);
    stage.before_substep(wind, [&stage, field, air](double) {
      for_each_moving(stage, [&](std::size_t, btRigidBody& body) {
        btVector3 centre;
        btScalar radius;
        body.getCollisionShape()->getBoundingSphere(centre, radius);
        const btVector3 relative = air - body.getLinearVelocity();
        const double area = std::numbers::pi * radius * radius;
        body.applyCentralForce(relative * (relative.length() * real(field.density / 2 * field.coefficient * area)));
      });
    });
  });
}

}  // namespace

const Effect wind{"wind",
                  "moving air pushes bodies",
                  "a force on each dynamic body before each substep",
                  called_for,
                  nullptr,
                  nullptr,
                  start};

}  // namespace boxstream::effects
