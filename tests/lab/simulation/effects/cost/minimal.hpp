// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <memory>
#include <vector>

#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>
#include <boxstream/bullet.hpp>

#include "simulation/engine/contacts/sliding_contacts.hpp"
#include "simulation/engine/last_iteration.hpp"
#include "simulation/run/state_hash.hpp"

namespace boxstream::effects_test {

/// A Bullet world written for exactly this scene: whatever Bullet does by default and makes no difference here is
/// switched off.
struct MinimalWorld {
  static constexpr btScalar step = btScalar(1.0 / 60);

  MinimalWorld() {
    world.setGravity(btVector3(0, btScalar(-9.81), 0));
    world.setForceUpdateAllAabbs(false);
    world.getDispatchInfo().m_useContinuous = false;
    world.getSolverInfo().m_splitImpulse = 0;
    world.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  }
  ~MinimalWorld() {
    for (auto& constraint : constraints) world.removeConstraint(constraint.get());
    for (auto& body : bodies) world.removeRigidBody(body.get());
  }
  MinimalWorld(const MinimalWorld&) = delete;
  MinimalWorld& operator=(const MinimalWorld&) = delete;

  /// `type` is a flag for collisions: 0, CF_STATIC_OBJECT or CF_KINEMATIC_OBJECT.
  btRigidBody& add(btCollisionShape& shape, btScalar mass, const btTransform& place, int type = 0) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
    info.m_startWorldTransform = place;
    bodies.push_back(std::make_unique<btRigidBody>(info));
    btRigidBody& body = *bodies.back();
    body.setFlags(0);
    if (type == btCollisionObject::CF_KINEMATIC_OBJECT) body.setCollisionFlags(type);
    if (type != btCollisionObject::CF_STATIC_OBJECT) body.setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(&body);
    return body;
  }

  void print_hash() {
    std::vector<btCollisionObject*> objects;
    for (auto& body : bodies) objects.push_back(body.get());
    std::vector<float> state;
    scenes::collect_state(objects, state);
    fmt::print("{:016x}\n", scenes::hash_of(state));
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  scenes::SlidingContacts sliding_contacts{dispatcher, configuration};
  bullet::Broadphase broadphase;
  scenes::SequentialImpulses solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<std::unique_ptr<btTypedConstraint>> constraints;
};

inline btTransform at(double x, double y, double z) {
  return btTransform(btQuaternion::getIdentity(),
                     btVector3(static_cast<btScalar>(x), static_cast<btScalar>(y), static_cast<btScalar>(z)));
}

}  // namespace boxstream::effects_test
