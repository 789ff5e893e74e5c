// SPDX-License-Identifier: MIT
#include "simulation/engine/multibodies.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletDynamics/Featherstone/btMultiBodyPoint2Point.h>

#include "simulation/engine/convert.hpp"
#include "simulation/engine/link_joint.hpp"
#include "simulation/engine/mass.hpp"

namespace boxstream::scenes {
namespace {

using Joints = std::vector<std::optional<LinkJoint>>;

btScalar mass_of(const btRigidBody& body) {
  return 1 / body.getInvMass();
}

/// `v` of the world, by the tensor of inertia of a body.
btVector3 times_inertia(const btRigidBody& body, const btVector3& v) {
  const btMatrix3x3& axes = body.getWorldTransform().getBasis();
  return axes * ((v * axes) * moments_of(body));
}

/// Below so much inertia about its axis Bullet holds a joint fast, and above so much mass it drops rows of the solver.
void check_weight(const btRigidBody& body, const LinkJoint* joint) {
  constexpr double least = 2.4e-7, most = 4e6;
  const auto fail = [&](const char* what) {
    throw std::invalid_argument("body " + std::to_string(body.getUserIndex()) + what +
                                " for multibodies: take another solver");
  };
  if (double{mass_of(body)} > most) fail(" has more than 4000 t, too much");
  if (joint == nullptr || joint->kind != LinkJoint::revolute) return;
  const btVector3 axis = vector(joint->axis), arm = body.getWorldTransform().getOrigin() - vector(joint->pivot);
  const double turned{axis.dot(times_inertia(body, axis)) + mass_of(body) * axis.cross(arm).length2()};
  if (turned < least) fail(" turns on its hinge with less than 2.4e-7 kg m^2, too little");
}

}  // namespace

/// What a link is in the world. What it does not touch is what its body does not touch.
class Multibodies::Collider final : public btMultiBodyLinkCollider {
 public:
  Collider(btMultiBody* multibody, int link, btRigidBody& body)
      : btMultiBodyLinkCollider(multibody, link), body_(body) {}

  bool checkCollideWithOverride(const btCollisionObject* other) const override {
    const btMultiBodyLinkCollider* const link = upcast(other);
    return body_.checkCollideWith(link == nullptr ? other : &static_cast<const Collider*>(link)->body_);
  }

 private:
  btRigidBody& body_;
};

bool Multibodies::Tree::is_asleep() const {
  return std::any_of(parts.begin(), parts.end(),
                     [](const Part& part) { return part.collider->getActivationState() == ISLAND_SLEEPING; });
}

Multibodies::Multibodies(MultibodyWorld& world, const JointTrees& trees, const Joints& joints, const Bodies& bodies,
                         bool damped, bool may_sleep)
    : world_(world), damped_(damped) {
  for (const JointTrees::Tree& description : trees.trees) {
    if (description.base) check_weight(*bodies[*description.base], nullptr);
    for (const JointTrees::Link& link : description.links) check_weight(*bodies[link.body], &*joints[link.joint]);
  }
  trees_.reserve(trees.trees.size());
  for (const JointTrees::Tree& description : trees.trees) {
    Tree& tree = trees_.emplace_back();
    add_links(description, joints, bodies, tree);
    add_colliders(tree, may_sleep);
    add_rows(trees, description, joints, tree);
    take_velocities(tree);
    show(tree);
    tree.motion = std::make_unique<Midpoint>(*tree.multibody);
  }
  world_.after_forces = [this] { for_each_awake([](Tree& tree) { tree.motion->begin(); }); };
}

Multibodies::~Multibodies() {
  world_.after_forces = nullptr;
  for (auto tree = trees_.rbegin(); tree != trees_.rend(); ++tree) {
    for (const auto& constraint : tree->constraints) world_.removeMultiBodyConstraint(constraint.get());
    for (const Motor& motor : tree->motors) world_.removeMultiBodyConstraint(motor.motor.get());
    for (auto part = tree->parts.rbegin(); part != tree->parts.rend(); ++part) {
      part->body->setBroadphaseHandle(nullptr);
      world_.removeCollisionObject(part->collider.get());
    }
    world_.removeMultiBody(tree->multibody.get());
  }
}

void Multibodies::add_links(const JointTrees::Tree& description, const Joints& joints, const Bodies& bodies,
                            Tree& tree) {
  const btRigidBody* const base = description.base ? bodies[*description.base].get() : nullptr;
  tree.multibody =
      std::make_unique<btMultiBody>(static_cast<int>(description.links.size()), base != nullptr ? mass_of(*base) : 0,
                                    base != nullptr ? moments_of(*base) : btVector3(0, 0, 0), base == nullptr, false);
  btMultiBody& multibody = *tree.multibody;
  const btTransform origin =
      base != nullptr ? base->getWorldTransform() : btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 0));
  multibody.setBaseWorldTransform(origin);
  // Bodies say how they are damped; their motion is that of Euler's equations.
  multibody.setLinearDamping(0);
  multibody.setAngularDamping(0);
  multibody.setUseGyroTerm(true);
  multibody.setMaxCoordinateVelocity(BT_LARGE_FLOAT);
  if (base != nullptr) tree.parts.push_back({bodies[*description.base].get(), -1, nullptr});

  for (std::size_t i = 0; i < description.links.size(); ++i) {
    const JointTrees::Link& link = description.links[i];
    const LinkJoint& joint = *joints[link.joint];
    btRigidBody& body = *bodies[link.body];
    const btTransform& place = body.getWorldTransform();
    const btTransform parent = link.parent ? bodies[description.links[*link.parent].body]->getWorldTransform() : origin;
    const btVector3 pivot = vector(joint.pivot), moments = moments_of(body);
    const btQuaternion turn = place.getRotation().inverse() * parent.getRotation();
    const btVector3 from_parent = parent.invXform(pivot), from_pivot = -place.invXform(pivot);
    // Angles and ways are those of the first body of a joint as seen from the other.
    const btScalar sense = joint.a == link.body ? 1 : -1;
    const btVector3 axis = (vector(joint.axis) * place.getBasis()) * sense;
    const int index = static_cast<int>(i), above = link.parent ? static_cast<int>(*link.parent) : -1;
    switch (joint.kind) {
      case LinkJoint::revolute:
        multibody.setupRevolute(index, mass_of(body), moments, above, turn, axis, from_parent, from_pivot, false);
        break;
      case LinkJoint::prismatic:
        multibody.setupPrismatic(index, mass_of(body), moments, above, turn, axis, from_parent, from_pivot, false);
        break;
      case LinkJoint::spherical:
        multibody.setupSpherical(index, mass_of(body), moments, above, turn, from_parent, from_pivot, false);
        break;
      case LinkJoint::fixed:
        multibody.setupFixed(index, mass_of(body), moments, above, turn, from_parent, from_pivot, false);
        break;
    }
    tree.parts.push_back({&body, index, nullptr});
  }
  multibody.finalizeMultiDof();
}

void Multibodies::add_colliders(Tree& tree, bool may_sleep) {
  btMultiBody& multibody = *tree.multibody;
  bool all_sleep = may_sleep;
  btScalar slow = 1;  // as a part of the speed that Bullet takes for slow
  for (Part& part : tree.parts) {
    btRigidBody& body = *part.body;
    const int group = body.getBroadphaseHandle()->m_collisionFilterGroup,
              mask = body.getBroadphaseHandle()->m_collisionFilterMask;
    part.velocity = body.getLinearVelocity();
    part.spin = body.getAngularVelocity();
    all_sleep = all_sleep && body.getActivationState() != DISABLE_DEACTIVATION;
    slow = btMin(slow, body.getLinearSleepingThreshold() / btScalar(0.8));
    world_.removeRigidBody(&body);
    part.collider = std::make_unique<Collider>(&multibody, part.link, body);
    Collider& collider = *part.collider;
    collider.setCollisionShape(body.getCollisionShape());
    collider.setWorldTransform(body.getWorldTransform());
    collider.setFriction(body.getFriction());
    collider.setRollingFriction(body.getRollingFriction());
    collider.setSpinningFriction(body.getSpinningFriction());
    collider.setRestitution(body.getRestitution());
    if (body.hasAnisotropicFriction()) collider.setAnisotropicFriction(body.getAnisotropicFriction());
    collider.setCollisionFlags(body.getCollisionFlags());
    collider.setContactProcessingThreshold(body.getContactProcessingThreshold());
    collider.setUserIndex(body.getUserIndex());
    collider.setUserIndex2(body.getUserIndex2());
    collider.setUserIndex3(body.getUserIndex3());
    collider.forceActivationState(body.getActivationState());
    if (part.link < 0)
      multibody.setBaseCollider(&collider);
    else
      multibody.getLink(part.link).m_collider = &collider;
    world_.addCollisionObject(&collider, group, mask);
    body.setBroadphaseHandle(collider.getBroadphaseHandle());
  }
  multibody.setCanSleep(all_sleep);
  multibody.setSleepThreshold(btScalar(0.05) * slow * slow);
  world_.addMultiBody(&multibody);
}

void Multibodies::add_rows(const JointTrees& trees, const JointTrees::Tree& description, const Joints& joints,
                           Tree& tree) {
  btMultiBody& multibody = *tree.multibody;
  const auto add = [&](std::unique_ptr<btMultiBodyConstraint> constraint) {
    world_.addMultiBodyConstraint(constraint.get());
    tree.constraints.push_back(std::move(constraint));
  };
  for (std::size_t i = 0; i < description.links.size(); ++i) {
    const LinkJoint& joint = *joints[description.links[i].joint];
    const int link = static_cast<int>(i);
    if (joint.limits) {
      auto limit = std::make_unique<JointLimit>(multibody, link, real((*joint.limits)[0]), real((*joint.limits)[1]));
      limit->finalizeMultiDof();
      add(std::move(limit));
    }
    if (!joint.motor) continue;
    // The impulse of a step bounds it: set before each.
    auto motor = std::make_unique<btMultiBodyJointMotor>(&multibody, link, real(joint.motor->speed), btScalar(1));
    // One of speed 0 mends a fifth of what it has crept in a step.
    if (joint.motor->speed == 0) motor->setPositionTarget(0, btScalar(0.2));
    motor->finalizeMultiDof();
    world_.addMultiBodyConstraint(motor.get());
    tree.motors.push_back({std::move(motor), link, joint.motor->max_force});
  }
  const auto close = [&](const LinkJoint& joint, const btVector3& pivot) {
    const auto place = [&](std::optional<std::size_t> body) { return body ? trees.places[*body]->link : -1; };
    const int a = place(joint.a), b = place(joint.b);
    auto held = std::make_unique<btMultiBodyPoint2Point>(
        &multibody, a, &multibody, b, multibody.worldPosToLocal(a, pivot), multibody.worldPosToLocal(b, pivot));
    held->setMaxAppliedImpulse(BT_LARGE_FLOAT);
    add(std::move(held));
  };
  for (const std::size_t index : description.closing) {
    const LinkJoint& joint = *joints[index];
    const btVector3 pivot = vector(joint.pivot);
    if (joint.kind == LinkJoint::spherical) {
      close(joint, pivot);
    } else {
      // Two points hold an axis.
      for (const btScalar side : {btScalar(-0.5), btScalar(0.5)}) close(joint, pivot + vector(joint.axis) * side);
    }
  }
}

// The impulses that the bodies have, given to links at rest: what joints do not let them have is lost, as where they
// caught.
void Multibodies::take_velocities(Tree& tree) {
  btMultiBody& multibody = *tree.multibody;
  for (const Part& part : tree.parts) {
    const btVector3 push = part.velocity * mass_of(*part.body), turn = times_inertia(*part.body, part.spin);
    if (part.link < 0) {
      multibody.addBaseForce(push);
      multibody.addBaseTorque(turn);
    } else {
      multibody.addLinkForce(part.link, push);
      multibody.addLinkTorque(part.link, turn);
    }
  }
  multibody.forwardKinematics(turns_, vectors_);
  multibody.computeAccelerationsArticulatedBodyAlgorithmMultiDof(1, scalars_, vectors_, matrices_, false, false, false);
  multibody.clearForcesAndTorques();
  multibody.updateCollisionObjectWorldTransforms(turns_, vectors_);
}

// Velocities that links and the base have are along their own axes.
void Multibodies::show(Tree& tree) {
  const btMultiBody& multibody = *tree.multibody;
  const int size = multibody.getNumLinks() + 1;
  vectors_.resize(2 * size);
  multibody.compTreeLinkVelocities(&vectors_[0], &vectors_[size]);
  for (Part& part : tree.parts) {
    btRigidBody& body = *part.body;
    const btTransform& place = part.collider->getWorldTransform();
    part.spin = place.getBasis() * vectors_[part.link + 1];
    part.velocity = place.getBasis() * vectors_[size + part.link + 1];
    body.setWorldTransform(place);
    body.setInterpolationWorldTransform(place);
    body.setLinearVelocity(part.velocity);
    body.setAngularVelocity(part.spin);
    body.updateInertiaTensor();
    body.forceActivationState(part.collider->getActivationState());
  }
}

template <class Do>
void Multibodies::for_each_awake(Do what) {
  for (Tree& tree : trees_)
    if (!tree.is_asleep()) what(tree);
}

void Multibodies::before_step(double dt) {
  for (Tree& tree : trees_) {
    tree.motion->drop();
    for (Motor& motor : tree.motors) motor.motor->setMaxAppliedImpulse(real(motor.force * dt));
    if (!tree.is_asleep()) continue;
    if (std::none_of(tree.parts.begin(), tree.parts.end(), [](const Part& part) { return part.body->isActive(); }))
      continue;
    tree.multibody->wakeUp();
    for (const Part& part : tree.parts) part.collider->forceActivationState(ACTIVE_TAG);
  }
}

void Multibodies::before_solver(double dt) {
  const btScalar rate = real(1 / dt);
  for_each_awake([&](Tree& tree) {
    btMultiBody& multibody = *tree.multibody;
    multibody.setUserIndex(0);
    for (Motor& motor : tree.motors) motor.before = multibody.getJointVel(motor.link);
    for (const Part& part : tree.parts) {
      btRigidBody& body = *part.body;
      if (damped_) body.applyDamping(real(dt));
      const btVector3 faster = body.getLinearVelocity() - part.velocity, turned = body.getAngularVelocity() - part.spin;
      const btVector3 force = body.getTotalForce() + faster * (mass_of(body) * rate),
                      torque = body.getTotalTorque() + times_inertia(body, turned) * rate;
      body.clearForces();
      if (part.link < 0) {
        multibody.addBaseForce(force);
        multibody.addBaseTorque(torque);
      } else {
        multibody.addLinkForce(part.link, force);
        multibody.addLinkTorque(part.link, torque);
      }
    }
    tree.motion->find(dt);
  });
}

void Multibodies::before_motion() {
  for_each_awake([](Tree& tree) { tree.motion->move(tree.multibody->getUserIndex() != 0); });
}

void Multibodies::after_motion() {
  for (Tree& tree : trees_) {
    if (!tree.is_asleep()) {
      if (tree.motion->end()) tree.multibody->updateCollisionObjectWorldTransforms(turns_, vectors_);
      moved_ += static_cast<std::uint64_t>(tree.multibody->getNumLinks());
      for (const Motor& motor : tree.motors)
        work_ += double{motor.motor->getAppliedImpulse(0)} *
                 (double{motor.before} + tree.multibody->getJointVel(motor.link)) / 2;
    }
    show(tree);
  }
}

}  // namespace boxstream::scenes
