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
    const double value = body.traits.material.spinning;
    return value > 0 ? fmt::format("spinning {}", value) : std::string{};
  });
}

constexpr btScalar faint = btScalar(1e-30);

void dress(const Subject&, const Body& description, btRigidBody& body) {
  body.setSpinningFriction(real(description.traits.material.spinning));
  // Bullet multiplies it with the other body's coefficient of sliding friction.
  // ... and leaves the rows of spinning out where there are none of rolling: these are too weak to roll anything.
  if (description.traits.material.spinning > 0 && body.getRollingFriction() == 0) body.setRollingFriction(faint);
  body.setFriction(real(description.traits.material.friction));
}

}  // namespace

const Effect spinning_friction{"spinning_friction",
                               "bodies that spin on the spot slow down",
                               "a row for each contact",
                               called_for,
                               nullptr,
                               dress};

}  // namespace boxstream::effects
