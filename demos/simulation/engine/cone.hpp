// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>

namespace boxstream::scenes {

/// A cone along y whose middle, halfway between base and apex, is at a height of one's choice: Bullet's own has it at
/// the origin, which is not where its mass is, and grows by its margin.
class Cone final : public btConvexInternalShape {
 public:
  /// `margin` rounds it, inside of what is described.
  Cone(btScalar radius, btScalar height, btScalar middle, btScalar margin = 0);

  // Without the margin.
  btScalar radius() const { return radius_; }
  btScalar base() const { return base_; }
  btScalar apex() const { return apex_; }

  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override;
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* corners,
                                                         int count) const override;
  void getAabb(const btTransform& place, btVector3& low, btVector3& high) const override;
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  btVector3 getAnisotropicRollingFrictionDirection() const override { return btVector3(0, 1, 0); }
  const char* getName() const override { return "Cone"; }

 private:
  btScalar radius_, base_, apex_, sine_;  // of half the angle at the apex
};

}  // namespace boxstream::scenes
