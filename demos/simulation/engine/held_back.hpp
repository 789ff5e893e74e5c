// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace boxstream::scenes {

/// Bullet stops a swept body where it hits, in the middle of a step, and leaves it the velocity that forces gave it for
/// the whole of it: energy that no fall paid for. Here forces act on such a body only for as long as it moved.
class HeldBack {
 public:
  using Bodies = btAlignedObjectArray<btRigidBody*>;

  /// To be called when a step of `dt` seconds begins, before forces give bodies velocities. Where it is not, less is
  /// known of the step. `acting_on`, if there is one, is called for each body that may be stopped though nothing pushes
  /// it.
  void begin_step(const Bodies& bodies, btScalar dt, const std::function<void(const btRigidBody&)>& acting_on);
  /// Right before bodies move.
  void begin_motion(const Bodies& bodies);
  /// Right after: `dt` seconds is what those moved that nothing stopped. Returns how many bodies were stopped.
  int end_motion(const Bodies& bodies, btScalar dt);

 private:
  struct Start {
    btVector3 velocity;
    double kinetic;
  };
  std::vector<Start> starts_;
  std::vector<btVector3> from_;
};

}  // namespace boxstream::scenes
