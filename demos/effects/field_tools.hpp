// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "effects/stage.hpp"

namespace boxstream::effects {

/// Each dynamic body that is in the world and awake, with its index.
template <class Visit>
void for_each_moving(const Stage& stage, Visit visit) {
  for (std::size_t i = 0; i < stage.bodies.size(); ++i) {
    btRigidBody& body = *stage.bodies[i];
    if (!body.isStaticOrKinematicObject() && body.isInWorld() && body.isActive()) visit(i, body);
  }
}

/// Force per speed beyond which a fluid would turn a body round within a substep of `dt` seconds: one that takes on the
/// speed of the fluid at once.
inline double most_strength(const btRigidBody& body, double dt) {
  return 1 / (double{body.getInvMass()} * dt);
}

/// Each field of the scene that is a T.
template <class T, class Visit>
void for_each_field(const Stage& stage, Visit visit) {
  for (const scenes::Field& field : stage.scene.fields)
    if (const auto* const kind = std::get_if<T>(&field)) visit(*kind);
}

}  // namespace boxstream::effects
