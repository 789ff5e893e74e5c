// SPDX-License-Identifier: MIT
#include "simulation/run/energy_account.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/kinetic_energy.hpp"

namespace boxstream::scenes {
namespace {

bool counts(const btRigidBody& body) {
  return !body.isStaticOrKinematicObject() && body.isInWorld();
}

/// How far a spring is drawn out.
btVector3 stretch(const btTypedConstraint& joint) {
  const auto& spring = static_cast<const btGeneric6DofSpring2Constraint&>(joint);
  return spring.getRigidBodyB().getCenterOfMassTransform() * spring.getFrameOffsetB().getOrigin() -
         spring.getRigidBodyA().getCenterOfMassTransform() * spring.getFrameOffsetA().getOrigin();
}

}  // namespace

double energy_of(const btRigidBody& body, const btVector3& gravity) {
  return kinetic_energy(body) - dot(gravity, body.getWorldTransform().getOrigin()) / double{body.getInvMass()};
}

EnergyAccount::EnergyAccount(const effects::SceneInstance& instance)
    : instance_(instance), lowest_(std::numeric_limits<double>::infinity()) {
  const std::size_t bodies = instance.bodies.size();
  of_body_.resize(bodies);
  before_.resize(bodies);
  for (const auto& body : instance.bodies) {
    btVector3 low, high;
    body->getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
    reach_.push_back(double{std::min({high.x() - low.x(), high.y() - low.y(), high.z() - low.z()})} / 2);
  }
  for (const Joint& joint : instance.expanded.joints)
    if (std::holds_alternative<SpringJoint>(joint.value)) stretched_.emplace_back(0, 0, 0);
}

// A step of the engine takes the force of a spring where the step begins, and moves bodies with the velocity at its
// end. What such steps keep is the product of the stretch before and after, not the square of either.
double EnergyAccount::springs() {
  double sum = 0;
  std::size_t next = 0;
  const auto& joints = instance_.expanded.joints;
  for (std::size_t i = 0; next < stretched_.size(); ++i) {
    const auto* const spring = std::get_if<SpringJoint>(&joints[i].value);
    if (spring == nullptr) continue;
    const btVector3 now = stretch(*instance_.joints[i]);
    sum += spring->stiffness * dot(now, is_running_ ? stretched_[next] : now) / 2;
    stretched_[next++] = now;
  }
  return sum;
}

double EnergyAccount::of_bodies() {
  const btVector3 gravity = instance_.world.world().getGravity();
  const double strength{gravity.length()};
  double sum = 0;
  mass_ = 0;
  for (std::size_t i = 0; i < of_body_.size(); ++i) {
    const btRigidBody& body = *instance_.bodies[i];
    of_body_[i] = 0;
    if (!counts(body)) continue;
    const btVector3& place = body.getWorldTransform().getOrigin();
    sum += of_body_[i] = energy_of(body, gravity);
    mass_ += 1 / double{body.getInvMass()};
    if (is_inside(instance_.scene.world.bounds, place))
      lowest_ = std::min(lowest_, (strength == 0 ? 0 : -dot(gravity, place) / strength) - reach_[i]);
  }
  return sum;
}

double EnergyAccount::in_world() const {
  // Faint enough to be seen nowhere; what rests without gravity has no energy to compare with.
  const double faint = mass_ * 1e-6 / 2;
  const double strength{instance_.world.world().getGravity().length()};
  return std::max(faint, energy_ - (std::isfinite(lowest_) ? mass_ * strength * lowest_ : 0));
}

/// Whether anything changes bodies between two steps of the engine.
bool EnergyAccount::is_touched() const {
  return !(instance_.first.empty() && instance_.before.empty() && instance_.after.empty() && instance_.last.empty() &&
           instance_.cars.empty() && instance_.walkers.empty() && instance_.soft_bodies.empty());
}

void EnergyAccount::begin_step() {
  gained_ = 0;
  at_start_ = true;
}

void EnergyAccount::before_substep() {
  const double before = energy_;
  if (!is_running_) {
    spring_energy_ = springs();
    energy_ = of_bodies() + spring_energy_;
    // What happened unseen is no part of the balance.
    balance_.first += energy_ - before;
    is_running_ = true;
  } else if (is_touched()) {
    energy_ = of_bodies() + spring_energy_;
    balance_.work.other += energy_ - before;
  }
  if (at_start_) {
    before_ = of_body_;
    in_world_before_ = in_world();
    at_start_ = false;
  }
  pushed_.clear();
  if (!instance_.scene.fields.empty())
    for (const auto& body : instance_.bodies)
      if (counts(*body) && !(body->getTotalForce().isZero() && body->getTotalTorque().isZero()))
        pushed_.push_back({body.get(), body->getTotalForce(), body->getTotalTorque(), body->getLinearVelocity(),
                           body->getAngularVelocity()});
  work_before_ = instance_.world.solver().work();
}

void EnergyAccount::after_motion(double dt) {
  const double before = energy_, worked_before = balance_.work.sum();
  spring_energy_ = springs();
  energy_ = of_bodies() + spring_energy_;
  Work& work = balance_.work;
  for (const Pushed& each : pushed_)
    work.fields += dt / 2 *
                   (dot(each.force, each.velocity + each.body->getLinearVelocity()) +
                    dot(each.torque, each.spin + each.body->getAngularVelocity()));
  const SolverWork& now = instance_.world.solver().work();
  work.motors += now.motors - work_before_.motors;
  work.surfaces += now.surfaces - work_before_.surfaces;
  const btVector3 gravity = instance_.world.world().getGravity();
  for (int axis = 0; axis < 3; ++axis)
    work.apart -= double{gravity[axis]} * (now.apart[axis] - work_before_.apart[axis]);
  gained_ += energy_ - before - (work.sum() - worked_before);
}

void EnergyAccount::end_step(std::uint64_t step) {
  ++balance_.steps;
  balance_.now = energy_;
  balance_.in_world = in_world();
  const double share = gained_ / std::max(in_world_before_, balance_.in_world - gained_);
  if (share <= tolerated) return;
  ++balance_.gains;
  if (balance_.worst && balance_.worst->share >= share) return;
  std::size_t most = 0;
  for (std::size_t i = 0; i < of_body_.size(); ++i)
    if (of_body_[i] - before_[i] > of_body_[most] - before_[most]) most = i;
  balance_.worst = Gain{step, gained_, share, most};
}

}  // namespace boxstream::scenes
