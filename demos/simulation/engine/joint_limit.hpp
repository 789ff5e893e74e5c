// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

namespace boxstream::scenes {

/// Where a hinge or slider of a multibody ends. Bullet's own lets it come as far beyond an end as it moves in a step,
/// and pushes it back after that; this one stops it there.
class JointLimit final : public btMultiBodyConstraint {
 public:
  JointLimit(btMultiBody& multibody, int link, btScalar low, btScalar high);

  void finalizeMultiDof() override;
  int getIslandIdA() const override;
  int getIslandIdB() const override { return getIslandIdA(); }
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  btScalar low_, high_;
};

}  // namespace boxstream::scenes
