// SPDX-License-Identifier: MIT
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "engine/convert.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_body(subject, [](const Body& body) {
    const double value = body.traits.material.rolling;
    return value > 0 ? fmt::format("rolling {}", value) : std::string{};
  });
}

void dress(const Subject&, const Body& description, btRigidBody& body) {
  body.setRollingFriction(real(description.traits.material.rolling));
  // Bullet multiplies it with the other body's coefficient of sliding friction.
  body.setFriction(real(description.traits.material.friction));
}

}  // namespace

const Effect rolling_friction{
    "rolling_friction", "rolling bodies slow down", "three rows for each contact", called_for, nullptr, dress};

}  // namespace boxstream::effects
