// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace boxstream::scenes {

/// Bullet stops a swept body where it hits, in the middle of a step, and leaves it the velocity that forces gave it for
/// the whole of it: energy that no fall paid for. Here forces act on such a body only for as long as it moved.
class HeldBack {
 public:
  /// To be called right before bodies move.
  void begin(const btAlignedObjectArray<btRigidBody*>& bodies);
  /// Right after: `dt` seconds is what those moved that nothing stopped. Returns how many bodies were stopped.
  int end(const btAlignedObjectArray<btRigidBody*>& bodies, btScalar dt);

 private:
  std::vector<btVector3> from_;
};

}  // namespace boxstream::scenes
