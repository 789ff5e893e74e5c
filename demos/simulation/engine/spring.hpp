// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>

namespace boxstream::scenes {

/// A spring that pulls the origins of two frames together, as strongly as it is stretched and whatever else acts.
///
/// Bullet's own aims at the velocity that the force would give two points in space, and stops pulling there. A point
/// that is off the centre of its body, which turns as well, needs more for that velocity, and so is pulled less than it
/// should be; and where gravity pulls the same way, it does the work in the spring's place. A spring between two
/// tumbling boxes then gains three quarters of its energy within a second.
class Spring final : public btGeneric6DofSpring2Constraint {
 public:
  Spring(btRigidBody& a, btRigidBody& b, const btTransform& in_a, const btTransform& in_b, btScalar stiffness,
         btScalar damping);

  void getInfo2(btConstraintInfo2* info) override;

 private:
  btScalar stiffness_, damping_;
};

}  // namespace boxstream::scenes
