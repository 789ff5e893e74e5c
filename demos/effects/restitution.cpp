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
    const double value = body.traits.material.restitution;
    return value > 0 ? fmt::format("restitution {}", value) : std::string{};
  });
}

void dress(const Subject&, const Body& description, btRigidBody& body) {
  body.setRestitution(real(description.traits.material.restitution));
}

}  // namespace

const Effect restitution{"restitution", "bodies bounce", "a coefficient of each body", called_for, nullptr, dress};

}  // namespace boxstream::effects
