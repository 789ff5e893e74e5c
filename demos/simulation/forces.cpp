// SPDX-License-Identifier: MIT
#include "simulation/forces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <LinearMath/btTransformUtil.h>

#include "simulation/convert.hpp"

namespace boxstream::scenes {

void apply_swirl(const SwirlField& swirl, const std::vector<std::unique_ptr<btRigidBody>>& bodies) {
  const btVector3 centre = vector(swirl.centre);
  const btScalar turns = real(swirl.speed / swirl.radius);
  const btScalar half_turns = real(std::numbers::pi / swirl.height);
  const btScalar strength = real(swirl.updraft / 2);
  for (const auto& body : bodies) {
    if (body->isStaticOrKinematicObject()) continue;
    const btVector3 r = body->getWorldTransform().getOrigin() - centre;
    // The convection comes from the stream function strength r^2 (1 - u^2) sin(pi y / height): nothing crosses floor,
    // lid or the cylinder u = 1, and what flows into any volume flows out of it.
    const btScalar u2 = std::min((r.x() * r.x() + r.z() * r.z()) / real(swirl.radius * swirl.radius), btScalar(1));
    const btScalar inwards = strength * (1 - u2) * half_turns * std::cos(half_turns * r.y());
    const btScalar up = strength * (2 - 4 * u2) * std::sin(half_turns * r.y());
    const btVector3 air(-turns * r.z() - inwards * r.x(), up, turns * r.x() - inwards * r.z());
    body->applyCentralForce((air - body->getLinearVelocity()) * (real(swirl.rate) / body->getInvMass()));
  }
}

void move_on(const Moved& moved, double dt) {
  btTransform next;
  btTransformUtil::integrateTransform(moved.body->getWorldTransform(), moved.velocity, moved.spin, real(dt), next);
  moved.body->setWorldTransform(next);
}

}  // namespace boxstream::scenes
