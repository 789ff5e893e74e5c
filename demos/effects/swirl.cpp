// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "effects/effects.hpp"
#include "effects/field_tools.hpp"
#include "effects/find.hpp"
#include "engine/convert.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

void apply(const SwirlField& swirl, const Stage& stage, double dt) {
  const btVector3 centre = vector(swirl.centre);
  const btScalar turns = real(swirl.speed / swirl.radius);
  const btScalar half_turns = real(std::numbers::pi / swirl.height);
  const btScalar strength = real(swirl.updraft / 2);
  const btScalar rate = real(std::min(swirl.rate, 1 / dt));
  for_each_moving(stage, [&](std::size_t, btRigidBody& body) {
    const btVector3 r = body.getWorldTransform().getOrigin() - centre;
    // The convection comes from the stream function strength r^2 (1 - u^2) sin(pi y / height): nothing crosses floor,
    // lid or the cylinder u = 1, and what flows into any volume flows out of it.
    const btScalar u2 = std::min((r.x() * r.x() + r.z() * r.z()) / real(swirl.radius * swirl.radius), btScalar(1));
    const btScalar inwards = strength * (1 - u2) * half_turns * std::cos(half_turns * r.y());
    const btScalar up = strength * (2 - 4 * u2) * std::sin(half_turns * r.y());
    const btVector3 air(-turns * r.z() - inwards * r.x(), up, turns * r.x() - inwards * r.z());
    body.applyCentralForce((air - body.getLinearVelocity()) * (rate / body.getInvMass()));
  });
}

std::optional<Call> called_for(const Subject& subject) {
  return first_kind<SwirlField>(subject.scene.fields, "/fields", "swirling air");
}

void start(Stage& stage) {
  for_each_field<SwirlField>(stage, [&](const SwirlField& field) {
    stage.before_substep(swirl, [&stage, field](double dt) { apply(field, stage, dt); });
  });
}

}  // namespace

const Effect swirl{"swirl",
                   "air drags bodies round and round",
                   "a force on each dynamic body before each substep",
                   called_for,
                   nullptr,
                   nullptr,
                   start};

}  // namespace boxstream::effects
