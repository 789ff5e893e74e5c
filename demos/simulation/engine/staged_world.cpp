// SPDX-License-Identifier: MIT
#include "simulation/engine/staged_world.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/engine/mass.hpp"

namespace boxstream::scenes {
namespace {

/// What is left of a velocity when `part` of it is taken back, as far as it is still there: contacts may have taken it.
btVector3 without(const btVector3& velocity, const btVector3& part) {
  const btScalar size = part.length2();
  return size == 0 ? velocity : velocity - part * std::clamp(velocity.dot(part) / size, btScalar(0), btScalar(1));
}

}  // namespace

void HeldBack::begin_step(const Bodies& bodies, btScalar dt, const std::function<void(const btRigidBody&)>& acting_on) {
  starts_.clear();
  for (int i = 0; i < bodies.size(); ++i) {
    const btRigidBody& body = *bodies[i];
    starts_.push_back({body.getLinearVelocity(), kinetic_energy(body)});
    if (!acting_on || body.getCcdMotionThreshold() == 0) continue;
    const btVector3 motion = (body.getLinearVelocity() + body.getTotalForce() * (body.getInvMass() * dt)) * dt;
    if (motion.length2() > body.getCcdSquareMotionThreshold()) acting_on(body);
  }
}

void HeldBack::begin_motion(const Bodies& bodies) {
  from_.clear();
  for (int i = 0; i < bodies.size(); ++i) from_.push_back(bodies[i]->getWorldTransform().getOrigin());
}

int HeldBack::end_motion(const Bodies& bodies, btScalar dt) {
  int stopped = 0;
  for (int i = 0; i < bodies.size(); ++i) {
    btRigidBody& body = *bodies[i];
    // Bullet's mark of a body that was stopped.
    if (body.getHitFraction() != 0) continue;
    ++stopped;
    const btVector3& force = body.getTotalForce();
    const btScalar whole = body.getLinearVelocity().length() * dt;
    if (whole == 0) continue;
    const btVector3 motion = body.getWorldTransform().getOrigin() - from_[static_cast<std::size_t>(i)];
    const btScalar rest = dt * std::clamp(1 - motion.length() / whole, btScalar(0), btScalar(1));
    const double before = kinetic_energy(body);
    body.setLinearVelocity(without(body.getLinearVelocity(), force * (body.getInvMass() * rest)));
    if (static_cast<int>(starts_.size()) != bodies.size()) continue;

    // Contacts may have made spin of what the force gave: of that, too, no more stays than the motion paid for.
    const Start& start = starts_[static_cast<std::size_t>(i)];
    const double paid = std::max(0.0, dot(force, motion));
    const double given = dt * (dot(force, start.velocity) + dot(force, force) * body.getInvMass() * dt / 2);
    const double most = std::max(before - std::max(0.0, given - paid), start.kinetic + paid),
                 now = kinetic_energy(body);
    if (now <= most) continue;
    const auto slower = static_cast<btScalar>(std::sqrt(most / now));
    body.setLinearVelocity(body.getLinearVelocity() * slower);
    body.setAngularVelocity(body.getAngularVelocity() * slower);
  }
  starts_.clear();
  return stopped;
}

}  // namespace boxstream::scenes
