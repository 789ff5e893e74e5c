// SPDX-License-Identifier: MIT
#pragma once

#include <BulletSoftBody/btSoftBody.h>

#include "simulation/effects/scene_instance.hpp"

// What effects count of a step that is just over, by what it left.
namespace boxstream::effects {

/// The number of dynamic bodies in the world that are awake and satisfy `which(body)`.
template <class Which>
std::uint64_t count_moving(const SceneInstance& instance, Which which) {
  std::uint64_t count = 0;
  for (const auto& body : instance.bodies)
    count += !body->isStaticOrKinematicObject() && body->isInWorld() && body->isActive() && which(*body);
  return count;
}

inline std::uint64_t count_moving(const SceneInstance& instance) {
  return count_moving(instance, [](const btRigidBody&) { return true; });
}

/// The number of contact points with an impulse that satisfy `which(point, object, object)`.
template <class Which>
std::uint64_t count_points(const SceneInstance& instance, Which which) {
  std::uint64_t count = 0;
  btDispatcher& dispatcher = instance.world.dispatcher();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
    // Manifolds of sleeping bodies keep what the solver wrote last.
    if (!a.isActive() && !b.isActive()) continue;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      count += point.getAppliedImpulse() > 0 && which(point, a, b);
    }
  }
  return count;
}

/// The number of soft-body nodes that touch an object with `which(soft body, object)`.
template <class Which>
std::uint64_t count_soft_points(const SceneInstance& instance, Which which) {
  std::uint64_t count = 0;
  for (const auto& soft : instance.soft_bodies)
    for (int i = 0; i < soft->m_rcontacts.size(); ++i) count += which(*soft, *soft->m_rcontacts[i].m_cti.m_colObj);
  return count;
}

/// Rows of the solver of one kind.
template <std::uint64_t scenes::SolverRows::*rows>
std::uint64_t count_rows(const SceneInstance& instance) {
  return instance.world.solver().rows().*rows;
}

/// Whether an object is a body with a shape of kind T.
template <class T>
bool has_shape(const SceneInstance& instance, const btCollisionObject& object) {
  const auto index = static_cast<std::size_t>(object.getUserIndex());
  return index < instance.bodies.size() &&
         std::holds_alternative<T>(instance.expanded.shapes[instance.expanded.bodies[index].traits.shape].value);
}

/// Contact points, soft ones included, of a body with a shape of kind T.
template <class T>
std::uint64_t count_points_of_shape(const SceneInstance& instance) {
  return count_points(instance,
                      [&](const btManifoldPoint&, const btCollisionObject& a, const btCollisionObject& b) {
                        return has_shape<T>(instance, a) || has_shape<T>(instance, b);
                      }) +
         count_soft_points(instance, [&](const btSoftBody&, const btCollisionObject& object) {
           return has_shape<T>(instance, object);
         });
}

}  // namespace boxstream::effects
