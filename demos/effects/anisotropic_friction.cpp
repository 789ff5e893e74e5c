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
    const Vec3& factors = body.traits.material.anisotropic;
    return factors != Vec3{1, 1, 1} ? fmt::format("factors [{}, {}, {}]", factors[0], factors[1], factors[2])
                                    : std::string{};
  });
}

void dress(const Subject&, const Body& description, btRigidBody& body) {
  const Vec3& factors = description.traits.material.anisotropic;
  if (factors != Vec3{1, 1, 1}) body.setAnisotropicFriction(vector(factors));
}

}  // namespace

const Effect anisotropic_friction{"anisotropic_friction",
                                  "bodies slide more easily one way than another",
                                  "setAnisotropicFriction of those bodies",
                                  called_for,
                                  nullptr,
                                  dress};

}  // namespace boxstream::effects
