// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/field_kit.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

void apply(const VortexField& vortex, const SceneInstance& instance, double dt) {
  const btVector3 centre = vector(vortex.centre);
  const btScalar turns = real(vortex.speed / vortex.radius);
  const btScalar half_turns = real(std::numbers::pi / vortex.height);
  const btScalar strength = real(vortex.updraft / 2);
  const btScalar rate = real(std::min(vortex.rate, 1 / dt));
  for_each_moving(instance, [&](std::size_t, btRigidBody& body) {
    const btVector3 r = body.getWorldTransform().getOrigin() - centre;
    // The convection comes from the stream function strength r^2 (1 - u^2) sin(pi y / height): nothing crosses floor,
    // lid or the cylinder u = 1, and what flows into any volume flows out of it.
    const btScalar u2 = std::min((r.x() * r.x() + r.z() * r.z()) / real(vortex.radius * vortex.radius), btScalar(1));
    const btScalar inwards = strength * (1 - u2) * half_turns * std::cos(half_turns * r.y());
    const btScalar up = strength * (2 - 4 * u2) * std::sin(half_turns * r.y());
    const btVector3 air(-turns * r.z() - inwards * r.x(), up, turns * r.x() - inwards * r.z());
    body.applyCentralForce((air - velocity_left(body, dt)) * (rate / body.getInvMass()));
  });
}

std::optional<Call> calls_for_vortex(const Subject& subject) {
  return called_for<VortexField>(subject, "swirling air", [](const VortexField& field) { return field.rate > 0; });
}

void start_vortex(SceneInstance& instance) {
  for_each_field<VortexField>(instance, [&](const VortexField& field) {
    instance.before_substep(vortex, [&instance, field](double dt) { apply(field, instance, dt); });
  });
}

}  // namespace

const Effect vortex{"vortex",
                    "air drags bodies round and round",
                    a_force,
                    calls_for_vortex,
                    {.start = start_vortex},
                    {"bodies", count_pushed<VortexField>}};

}  // namespace boxstream::effects
