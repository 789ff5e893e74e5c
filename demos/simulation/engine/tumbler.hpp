// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "simulation/engine/free_rotation.hpp"

namespace boxstream::scenes {

/// Turns one body of a Bullet world by its own inertia, in place of Bullet, which moves bodies as if their spin stayed.
///
/// A body that the solver leaves alone moves as if it were free, exactly but for the order of the method. One that
/// joints or contacts act on is turned by Bullet, with the velocity that they allow, and its momentum stays in the
/// world: its spin becomes the one that has this momentum in the new orientation, or less, so that no energy is added.
/// The next solve of the joints is against that. Spin and orientation of a free body are kept in double precision from
/// step to step, for Bullet's may be single.
class Tumbler {
 public:
  /// Whether it has a moment of inertia about each axis, and may turn about each.
  static bool can_turn(const btRigidBody& body);
  /// `body` outlives this and can turn.
  explicit Tumbler(btRigidBody& body);

  // Calls in each substep, in this order.

  /// Forces are there and the solver has not begun: takes the torque for its own.
  void before_solver(double dt);
  /// The solver is done.
  void before_motion(double dt);
  void after_motion();

 private:
  void take_state();

  btRigidBody* body_;
  FreeRotation free_;
  btVector3 moments_;
  FreeRotation::State state_{};
  // What of the state Bullet was given: as long as it stands there, the state does.
  btVector3 shown_spin_{0, 0, 0};
  btMatrix3x3 shown_basis_;
  // Before the solver, which then has not touched the body if they stay.
  btVector3 spin_{0, 0, 0};
  btMatrix3x3 basis_;
  btVector3 momentum_{0, 0, 0};  // of a body that is held
  enum { resting, free, held } motion_ = resting;
};

}  // namespace boxstream::scenes
