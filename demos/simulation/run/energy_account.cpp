// SPDX-License-Identifier: MIT
#include "simulation/run/energy_account.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/tumbler.hpp"

namespace boxstream::scenes {
namespace {

// Substeps from one look at all bodies to the next. They cost about as much as flying free does.
constexpr std::uint64_t look_every = 64, look_every_if_vague = 16;

bool counts(const btRigidBody& body) {
  return !body.isStaticOrKinematicObject() && body.isInWorld();
}

/// How far a spring is drawn out.
btVector3 stretch(const btTypedConstraint& joint) {
  const auto& spring = static_cast<const btGeneric6DofSpring2Constraint&>(joint);
  return spring.getRigidBodyB().getCenterOfMassTransform() * spring.getFrameOffsetB().getOrigin() -
         spring.getRigidBodyA().getCenterOfMassTransform() * spring.getFrameOffsetA().getOrigin();
}

/// Joints leave the world with either of their bodies.
bool is_in_world(const effects::SceneInstance& instance, const Joint& joint) {
  return instance.bodies[joint.a]->isInWorld() && (!joint.b || instance.bodies[*joint.b]->isInWorld());
}

/// Whether nothing keeps the energy of a body that spins freely.
bool turns_as_if_its_spin_stayed(const effects::SceneInstance& instance, std::size_t index) {
  const btVector3& moments = instance.bodies[index]->getInvInertiaDiagLocal();
  const std::optional<Gyro>& gyro = instance.expanded.bodies[index].traits.gyro;
  const bool some_keep_it = std::any_of(instance.moved.begin(), instance.moved.end(),
                                        [](const effects::Hook& hook) { return hook.effect == &effects::gyroscopic; });
  return !(moments.x() == moments.y() && moments.y() == moments.z()) &&
         !(some_keep_it && gyro.value_or(Gyro::conserving) == Gyro::conserving &&
           Tumbler::can_turn(*instance.bodies[index]));
}

}  // namespace

double energy_of(const btRigidBody& body, const btVector3& gravity) {
  const Inertia inertia = inertia_of(body);
  return kinetic_energy(body, inertia) - inertia.mass * dot(gravity, body.getWorldTransform().getOrigin());
}

double energy_of_springs(const effects::SceneInstance& instance) {
  double sum = 0;
  const std::vector<Joint>& joints = instance.expanded.joints;
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (const auto* const spring = std::get_if<SpringJoint>(&joints[i].value);
        spring != nullptr && is_in_world(instance, joints[i])) {
      const btVector3 now = stretch(*instance.joints[i]);
      sum += spring->stiffness * dot(now, now) / 2;
    }
  return sum;
}

double energy_in_world(const effects::SceneInstance& instance) {
  EnergyAccount account(instance);
  account.before_substep();
  return account.balance().in_world;
}

EnergyAccount::EnergyAccount(const effects::SceneInstance& instance)
    : instance_(instance),
      lowest_(std::numeric_limits<double>::infinity()),
      is_vague_(!instance.soft_bodies.empty() || instance.scene.world.tumbling.has_value()) {
  for (std::size_t i = 0; i < instance.bodies.size(); ++i) {
    const btRigidBody& body = *instance.bodies[i];
    btVector3 low, high;
    body.getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
    const double thickness{std::min({high.x() - low.x(), high.y() - low.y(), high.z() - low.z()})};
    known_.push_back({inertia_of(body), thickness / 2, !instance.subject.trees.has_body(i)});
    if (turns_as_if_its_spin_stayed(instance, i)) spinners_.push_back(i);
  }
  const std::vector<Joint>& joints = instance.expanded.joints;
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (const auto* const spring = std::get_if<SpringJoint>(&joints[i].value))
      springs_.push_back({i, spring->stiffness, btVector3(0, 0, 0)});
}

// A step of the engine takes the force of a spring where the step begins, and moves bodies with the velocity at its
// end. What such steps keep is the product of the stretch before and after, not the square of either.
double EnergyAccount::springs() {
  double sum = 0;
  for (Spring& spring : springs_) {
    const bool acts = is_in_world(instance_, instance_.expanded.joints[spring.joint]);
    const btVector3 now = acts ? stretch(*instance_.joints[spring.joint]) : btVector3(0, 0, 0);
    spring.energy = spring.stiffness * dot(now, is_running_ ? spring.stretch : now) / 2;
    spring.stretch = now;
    sum += spring.energy;
  }
  return sum;
}

/// The energy of a body now, which is known from here on.
double EnergyAccount::look_at(std::size_t index) {
  const btRigidBody& body = *instance_.bodies[index];
  Known& known = known_[index];
  known.seen = moment_;
  known.energy = 0;
  if (!counts(body)) return 0;
  const btVector3& place = body.getWorldTransform().getOrigin();
  const double potential = -dot(gravity_, place), low = potential - strength_ * known.reach;
  if (low < lowest_ && is_inside(instance_.scene.world.bounds, place)) lowest_ = low;
  const double ahead = known.falls_ahead ? dot(gravity_, body.getLinearVelocity()) * instance_.substep / 2 : 0;
  return known.energy = kinetic_energy(body, known.inertia) + known.inertia.mass * (potential + ahead);
}

void EnergyAccount::look_at_all() {
  gravity_ = instance_.world.world().getGravity();
  strength_ = double{gravity_.length()};
  since_look_ = 0;
  mass_ = 0;
  energy_ = spring_energy_;
  for (std::size_t i = 0; i < known_.size(); ++i) {
    energy_ += look_at(i);
    if (counts(*instance_.bodies[i])) mass_ += known_[i].inertia.mass;
  }
}

double EnergyAccount::in_world() const {
  // Faint enough to be seen nowhere; what rests without gravity has no energy to compare with.
  const double faint = mass_ * 1e-6 / 2;
  return std::max(faint, energy_ - (std::isfinite(lowest_) ? mass_ * lowest_ : 0));
}

/// What came between steps of the engine is no gain.
void EnergyAccount::settle() {
  for (const Acted& each : between_) {
    const double change = look_at(each.body) - each.before;
    energy_ += change;
    balance_.work.other += change;
    mass_ += known_[each.body].inertia.mass * (int{counts(*instance_.bodies[each.body])} - int{each.counted});
  }
  for (Spring& spring : springs_) {
    if (is_in_world(instance_, instance_.expanded.joints[spring.joint])) continue;
    spring_energy_ -= spring.energy;
    energy_ -= spring.energy;
    balance_.work.other -= spring.energy;
    spring.energy = 0;
    spring.stretch.setZero();
  }
  between_.clear();
}

void EnergyAccount::look_back() {
  settle();
  ++moment_;
  reckoned_.clear();
  for (const Known& known : known_) reckoned_.push_back(known.energy);
  const double reckoned = energy_;
  look_at_all();
  const double more = energy_ - reckoned;
  if (is_vague_) {
    balance_.work.other += more;
  } else if (const double share = more / in_world(); share > tolerated) {
    acted_.clear();
    for (std::size_t i = 0; i < known_.size(); ++i)
      acted_.push_back({i, reckoned_[i], known_[i].energy - reckoned_[i], true});
    note_gain(more, share);
  }
}

void EnergyAccount::begin_step() {
  gained_ = 0;
  at_start_ = true;
  acted_.clear();
}

void EnergyAccount::before_substep() {
  if (!is_running_) {
    const double before = energy_;
    spring_energy_ = springs();
    between_.clear();
    ++moment_;
    look_at_all();
    // What happened unseen is no part of the balance.
    balance_.first += energy_ - before;
    is_running_ = true;
  } else {
    settle();
    gravity_ = instance_.world.world().getGravity();
  }
  if (at_start_) {
    in_world_before_ = in_world();
    at_start_ = false;
  }
  ++moment_;
  is_within_ = true;
  first_acted_ = acted_.size();
  pushed_.clear();
  if (!instance_.scene.fields.empty())
    for (std::size_t i = 0; i < known_.size(); ++i)
      if (const btRigidBody& body = *instance_.bodies[i];
          counts(body) && !(body.getTotalForce().isZero() && body.getTotalTorque().isZero()))
        pushed_.push_back(
            {i, body.getTotalForce(), body.getTotalTorque(), body.getLinearVelocity(), body.getAngularVelocity()});
  for (const std::size_t i : spinners_)
    if (const btRigidBody& body = *instance_.bodies[i]; body.isActive() && !body.getAngularVelocity().isZero())
      acting_on(body);
  work_before_ = instance_.world.solver().work();
}

void EnergyAccount::acting_on(const btRigidBody& body) {
  const auto index = static_cast<std::size_t>(body.getUserIndex());
  // It may be no body of the scene.
  if (index >= known_.size()) return;
  Known& known = known_[index];
  if (known.listed == moment_ || !is_running_) return;
  known.listed = moment_;
  if (is_within_) {
    const bool is_known = known.seen + 1 == moment_ && !is_vague_;
    acted_.push_back({index, is_known ? known.energy : look_at(index), 0, true});
  } else {
    between_.push_back({index, look_at(index), 0, counts(body)});
  }
}

void EnergyAccount::after_motion(double dt) {
  ++moment_;
  is_within_ = false;
  const double springs_before = spring_energy_, worked_before = balance_.work.sum();
  spring_energy_ = springs();
  double gained = spring_energy_ - springs_before;
  for (std::size_t k = first_acted_; k < acted_.size(); ++k) {
    Acted& each = acted_[k];
    each.gained = look_at(each.body) - each.before;
    gained += each.gained;
  }
  Work& work = balance_.work;
  const SolverWork& now = instance_.world.solver().work();
  work.motors += now.motors - work_before_.motors;
  work.surfaces += now.surfaces - work_before_.surfaces;
  for (int axis = 0; axis < 3; ++axis)
    work.apart -= double{gravity_[axis]} * (now.apart[axis] - work_before_.apart[axis]);
  for (const Pushed& each : pushed_) {
    const btRigidBody& body = *instance_.bodies[each.body];
    const double done = dt / 2 *
                        (dot(each.force, each.velocity + body.getLinearVelocity()) +
                         dot(each.torque, each.spin + body.getAngularVelocity()));
    work.fields += done;
    // All of it is in the motion of what nothing else acts on.
    if (known_[each.body].listed + 1 != moment_) gained += done;
  }
  energy_ += gained;
  gained_ += gained - (work.sum() - worked_before);
  // Rays take what they find for a fixed body: wheels push the chassis alone.
  for (const effects::Car& car : instance_.cars) acting_on(*car.vehicle->getRigidBody());
  ++since_look_;
}

void EnergyAccount::end_step(std::uint64_t step) {
  ++balance_.steps;
  step_ = step;
  const double share = gained_ / std::max(in_world_before_, in_world() - gained_);
  if (share > tolerated) note_gain(gained_, share);
  if (since_look_ >= (is_vague_ ? look_every_if_vague : look_every)) look_back();
}

/// Of the step that ends: `acted_` says which body gained how much.
void EnergyAccount::note_gain(double energy, double share) {
  ++balance_.gains;
  if (balance_.worst && balance_.worst->share >= share) return;
  std::vector<double> gained(known_.size());
  for (const Acted& each : acted_) gained[each.body] += each.gained;
  const auto most = std::max_element(gained.begin(), gained.end());
  balance_.worst = Gain{step_, energy, share, static_cast<std::size_t>(most - gained.begin())};
}

void EnergyAccount::interrupt() {
  if (is_running_) balance();
  is_running_ = false;
}

const EnergyBalance& EnergyAccount::balance() {
  if (is_running_) {
    look_back();
    balance_.now = energy_;
    balance_.in_world = in_world();
  }
  return balance_;
}

}  // namespace boxstream::scenes
