// SPDX-License-Identifier: MIT
#include "scene/forces.hpp"

#include <algorithm>
#include <cmath>

#include <LinearMath/btTransformUtil.h>

#include "scene/convert.hpp"

namespace boxstream::scenes {

void apply_swirl(const SwirlField& swirl, const std::vector<std::unique_ptr<btRigidBody>>& bodies) {
  const btVector3 centre = vector(swirl.centre);
  for (const auto& body : bodies) {
    if (body->isStaticOrKinematicObject()) continue;
    const btVector3 r = body->getWorldTransform().getOrigin() - centre;
    const btScalar distance = std::sqrt(r.x() * r.x() + r.z() * r.z());
    if (!(distance > 0)) continue;
    // The air turns as a rigid whole out to `radius` and at constant speed beyond; it rises in the middle and falls
    // outside.
    const btScalar u = distance / real(swirl.radius);
    const btScalar around = real(swirl.speed) * std::min(u, btScalar(1));
    const btScalar up = real(swirl.updraft) * (u < 1 ? 1 - u : std::max(1 - u, btScalar(-1)));
    const btVector3 air(-r.z() / distance * around, up, r.x() / distance * around);
    body->applyCentralForce((air - body->getLinearVelocity()) * (real(swirl.rate) / body->getInvMass()));
  }
}

void move_on(const Moved& moved, double dt) {
  btTransform next;
  btTransformUtil::integrateTransform(moved.body->getWorldTransform(), moved.velocity, moved.spin, real(dt), next);
  moved.body->setWorldTransform(next);
}

}  // namespace boxstream::scenes
