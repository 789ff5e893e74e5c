// SPDX-License-Identifier: MIT
#include <algorithm>
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

/// Bullet's own takes a sphere for the box around it.
double bounding_radius(const btCollisionShape& shape) {
  if (shape.getShapeType() == SPHERE_SHAPE_PROXYTYPE) return static_cast<const btSphereShape&>(shape).getRadius();
  btVector3 centre;
  btScalar radius;
  shape.getBoundingSphere(centre, radius);
  return radius;
}

void start(Stage& stage) {
  for_each_field<WindField>(stage, [&](const WindField& field) {
    const btVector3 air = vector(field.velocity);
    stage.before_substep(wind, [&stage, field, air](double dt) {
      for_each_moving(stage, [&](std::size_t, btRigidBody& body) {
        const double radius = bounding_radius(*body.getCollisionShape());
        const btVector3 relative = air - body.getLinearVelocity();
        const double area = std::numbers::pi * radius * radius;
        const double strength = field.density / 2 * field.coefficient * area * relative.length();
        body.applyCentralForce(relative * real(std::min(strength, most_strength(body, dt))));
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
