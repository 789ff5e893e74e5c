// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "simulation/effects/activity.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"

// What effects of fields have in common: air and fluids are forces on each dynamic body before each substep.
namespace boxstream::effects {

constexpr const char* a_force = "a force on each dynamic body before each substep";

/// Each dynamic body that is in the world and awake, with its index.
template <class Visit>
void for_each_moving(const SceneInstance& instance, Visit visit) {
  for (std::size_t i = 0; i < instance.bodies.size(); ++i) {
    btRigidBody& body = *instance.bodies[i];
    if (!body.isStaticOrKinematicObject() && body.isInWorld() && body.isActive()) visit(i, body);
  }
}

/// Force per speed beyond which a fluid would turn a body round within a substep of `dt` seconds: one that takes on the
/// speed of the fluid at once.
inline double most_strength(const btRigidBody& body, double dt) {
  return 1 / (double{body.getInvMass()} * dt);
}

/// What the fields so far leave of a body's velocity in a substep of `dt` seconds. Each field slows down what those
/// before it have left: together they bring a light body to rest at most, and do not turn it round.
inline btVector3 velocity_left(const btRigidBody& body, double dt) {
  return body.getLinearVelocity() + body.getTotalForce() * (body.getInvMass() * scenes::real(dt));
}
inline btVector3 spin_left(const btRigidBody& body, double dt) {
  return body.getAngularVelocity() + body.getInvInertiaTensorWorld() * body.getTotalTorque() * scenes::real(dt);
}

/// Each field of the scene that is a T.
template <class T, class Visit>
void for_each_field(const SceneInstance& instance, Visit visit) {
  for (const scenes::Field& field : instance.scene.fields)
    if (const auto* const kind = std::get_if<T>(&field)) visit(*kind);
}

/// By the first field that is a T and can change the velocity of a body: `acts(field)`.
template <class T, class Acts>
std::optional<Call> called_for(const Subject& subject, const char* reason, Acts acts) {
  const std::vector<scenes::Field>& fields = subject.scene.fields;
  if (!has_dynamic(subject)) return std::nullopt;
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (const auto* const field = std::get_if<T>(&fields[i]); field != nullptr && acts(*field))
      return Call{fmt::format("/fields/{}", i), reason};
  return std::nullopt;
}

/// Of each body a Made, of its shape and of the shape's pose in the body; nothing of bodies that are not dynamic.
/// Bodies of one shape share one.
template <class Made>
std::vector<std::shared_ptr<const Made>> for_each_shape(SceneInstance& instance) {
  struct Posed {
    btTransform frame;
    std::shared_ptr<const Made> made;
  };
  std::vector<std::vector<Posed>> by_shape(instance.expanded.shapes.size());
  std::vector<std::shared_ptr<const Made>> of_bodies;
  for (std::size_t i = 0; i < instance.bodies.size(); ++i) {
    const scenes::Body& body = instance.expanded.bodies[i];
    if (!is_dynamic(body)) {
      of_bodies.push_back(nullptr);
      continue;
    }
    std::vector<Posed>& made = by_shape[body.traits.shape];
    const btTransform& frame = instance.frame(i);
    // Those with an inertia of their own may have another frame.
    auto known = std::find_if(made.begin(), made.end(), [&](const Posed& posed) { return posed.frame == frame; });
    if (known == made.end())
      known = made.insert(made.end(),
                          {frame, std::make_shared<const Made>(instance.shapes, body.traits.shape, frame.inverse())});
    of_bodies.push_back(known->made);
  }
  return of_bodies;
}

template <class T>
std::uint64_t count_pushed(const SceneInstance& instance) {
  std::uint64_t count = 0;
  for_each_field<T>(instance, [&](const T&) { count += count_moving(instance); });
  return count;
}

}  // namespace boxstream::effects
