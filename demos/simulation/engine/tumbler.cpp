// SPDX-License-Identifier: MIT
#include "simulation/engine/tumbler.hpp"

#include "formats/geometry/frame.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/mass.hpp"

namespace boxstream::scenes {
namespace {

/// A turn within a step of less than this is nothing in single precision.
constexpr double least_angle = 1e-8;

btMatrix3x3 basis_of(const Quat& q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return btMatrix3x3(real(1 - 2 * (y * y + z * z)), real(2 * (x * y - z * w)), real(2 * (x * z + y * w)),
                     real(2 * (x * y + z * w)), real(1 - 2 * (x * x + z * z)), real(2 * (y * z - x * w)),
                     real(2 * (x * z - y * w)), real(2 * (y * z + x * w)), real(1 - 2 * (x * x + y * y)));
}

}  // namespace

Tumbler::Tumbler(btRigidBody& body) : body_(&body), free_(exact(moments_of(body))), moments_(moments_of(body)) {
  shown_basis_.setIdentity();
  basis_.setIdentity();
}

bool Tumbler::can_turn(const btRigidBody& body) {
  const btVector3& inverse = body.getInvInertiaDiagLocal();
  return inverse.x() > 0 && inverse.y() > 0 && inverse.z() > 0 && body.getAngularFactor() == btVector3(1, 1, 1);
}

/// From Bullet's, unless it is as it was left.
void Tumbler::take_state() {
  if (spin_ == shown_spin_ && basis_ == shown_basis_) return;
  btQuaternion q;
  basis_.getRotation(q);
  state_.rotation = {q.x(), q.y(), q.z(), q.w()};
  state_.spin = exact(spin_ * basis_);
}

void Tumbler::before_solver(double dt) {
  motion_ = resting;
  if (!body_->isActive() || !body_->isInWorld()) return;
  if (const btVector3& torque = body_->getTotalTorque(); !torque.isZero()) {
    body_->setAngularVelocity(body_->getAngularVelocity() + body_->getInvInertiaTensorWorld() * torque * real(dt));
    body_->applyTorque(-torque);
  }
  spin_ = body_->getAngularVelocity();
  basis_ = body_->getWorldTransform().getBasis();
  motion_ = held;
}

void Tumbler::before_motion(double dt) {
  if (motion_ == resting) return;
  const btVector3& spin = body_->getAngularVelocity();
  const btMatrix3x3& basis = body_->getWorldTransform().getBasis();
  const double least = least_angle / dt;
  if (!(double{spin.length2()} > least * least)) {
    motion_ = resting;
  } else if (spin == spin_ && basis == basis_) {
    take_state();
    if (free_.advance(dt, state_))
      motion_ = free;
    else
      motion_ = resting;
  } else {
    momentum_ = basis * (spin * basis * moments_);
  }
}

void Tumbler::after_motion() {
  if (motion_ == free) {
    shown_spin_ = vector(geometry::turned(state_.rotation, state_.spin));
    shown_basis_ = basis_of(state_.rotation);
    body_->setAngularVelocity(shown_spin_);
    body_->setCenterOfMassTransform(btTransform(shown_basis_, body_->getWorldTransform().getOrigin()));
  } else if (motion_ == held) {
    const btVector3& before = body_->getAngularVelocity();
    const btVector3 after = body_->getInvInertiaTensorWorld() * momentum_;
    const btScalar energy = before.dot(momentum_), more = after.dot(momentum_);
    body_->setAngularVelocity(more > energy ? after * btSqrt(energy / more) : after);
  }
}

}  // namespace boxstream::scenes
