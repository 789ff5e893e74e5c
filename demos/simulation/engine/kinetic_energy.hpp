// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "formats/geometry/frame.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {

/// In double precision, of what Bullet has in its own.
inline double dot(const btVector3& a, const btVector3& b) {
  return geometry::dot(exact(a), exact(b));
}

/// Joules, with the whole tensor of inertia; 0 of what has no finite mass.
inline double kinetic_energy(const btRigidBody& body) {
  double twice =
      body.getInvMass() > 0 ? dot(body.getLinearVelocity(), body.getLinearVelocity()) / body.getInvMass() : 0;
  const btVector3 spin = body.getWorldTransform().getBasis().transpose() * body.getAngularVelocity();
  for (int axis = 0; axis < 3; ++axis)
    if (const double inverse = body.getInvInertiaDiagLocal()[axis]; inverse > 0)
      twice += double{spin[axis]} * spin[axis] / inverse;
  return twice / 2;
}

}  // namespace boxstream::scenes
