// SPDX-License-Identifier: MIT
#include "simulation/engine/held_back.hpp"

#include <algorithm>
#include <cmath>

namespace boxstream::scenes {
namespace {

/// What is left of a velocity when `part` of it is taken back. Where a contact has taken it already, taking it once
/// more would drive the body the other way, so nothing is taken that makes it faster.
btVector3 without(const btVector3& velocity, const btVector3& part) {
  const btVector3 less = velocity - part;
  return less.length2() < velocity.length2() ? less : velocity;
}

}  // namespace

void HeldBack::begin(const btAlignedObjectArray<btRigidBody*>& bodies) {
  from_.clear();
  for (int i = 0; i < bodies.size(); ++i) from_.push_back(bodies[i]->getWorldTransform().getOrigin());
}

int HeldBack::end(const btAlignedObjectArray<btRigidBody*>& bodies, btScalar dt) {
  int stopped = 0;
  for (int i = 0; i < bodies.size(); ++i) {
    btRigidBody& body = *bodies[i];
    // Bullet's mark of a body that was stopped.
    if (body.getHitFraction() != 0) continue;
    ++stopped;
    const btScalar whole = body.getLinearVelocity().length() * dt;
    if (whole == 0) continue;
    const btScalar moved = (body.getWorldTransform().getOrigin() - from_[static_cast<std::size_t>(i)]).length();
    const btScalar rest = dt * std::clamp(1 - moved / whole, btScalar(0), btScalar(1));
    body.setLinearVelocity(without(body.getLinearVelocity(), body.getTotalForce() * (body.getInvMass() * rest)));
    body.setAngularVelocity(
        without(body.getAngularVelocity(), body.getInvInertiaTensorWorld() * body.getTotalTorque() * rest));
  }
  return stopped;
}

}  // namespace boxstream::scenes
