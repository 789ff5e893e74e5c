// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "formats/geometry/frame.hpp"
#include "formats/geometry/solid.hpp"
#include "formats/scene_model/bodies.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {

/// What an engine needs of a body that moves: bodies of engines are where their centre of mass is, and have their
/// principal axes.
struct Mass {
  double mass = 0;        // kg
  Vec3 moments{};         // kg m^2, about the axes of `frame`
  geometry::Frame frame;  // centre of mass and principal axes, in the coordinates in which the body is described
};

/// By its solid, as far as the body says nothing of its own. Nothing of a body that is not dynamic, and the frame that
/// it is described in: it moves as it is told.
Mass mass_of(const Body& body, const geometry::Solid& solid);

/// In double precision, of what Bullet has in its own.
inline double dot(const btVector3& a, const btVector3& b) {
  return geometry::dot(exact(a), exact(b));
}

/// Mass and moments of inertia about a body's own axes, in kg and kg m^2; 0 of what nothing can move or turn.
struct Inertia {
  double mass = 0;
  double moments[3] = {0, 0, 0};
};

inline Inertia inertia_of(const btRigidBody& body) {
  const auto inverse = [](btScalar of) { return of > 0 ? 1 / double{of} : 0; };
  const btVector3& turning = body.getInvInertiaDiagLocal();
  return {inverse(body.getInvMass()), {inverse(turning.x()), inverse(turning.y()), inverse(turning.z())}};
}

/// About the own axes of a body that can turn about each, in kg m^2, as Bullet reckons with them.
inline btVector3 moments_of(const btRigidBody& body) {
  const btVector3& inverse = body.getInvInertiaDiagLocal();
  return btVector3(1 / inverse.x(), 1 / inverse.y(), 1 / inverse.z());
}

/// Joules, with the whole tensor of inertia; 0 of what has no finite mass.
inline double kinetic_energy(const btRigidBody& body, const Inertia& inertia) {
  double twice = inertia.mass * dot(body.getLinearVelocity(), body.getLinearVelocity());
  const btVector3 spin = body.getAngularVelocity() * body.getWorldTransform().getBasis();
  for (int axis = 0; axis < 3; ++axis) twice += inertia.moments[axis] * double{spin[axis]} * spin[axis];
  return twice / 2;
}
inline double kinetic_energy(const btRigidBody& body) {
  return kinetic_energy(body, inertia_of(body));
}

}  // namespace boxstream::scenes
