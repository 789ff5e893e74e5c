// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

namespace boxstream::scenes {

/// Bullet's world of multibodies, with a place between its own accelerations and its solver.
class MultibodyWorld : public btMultiBodyDynamicsWorld {
 public:
  using btMultiBodyDynamicsWorld::btMultiBodyDynamicsWorld;

  void solveExternalForces(btContactSolverInfo& info) override {
    btMultiBodyDynamicsWorld::solveExternalForces(info);
    if (after_forces) after_forces();
  }

  std::function<void()> after_forces;  ///< velocities have forces in them, and nothing of the solver yet
};

}  // namespace boxstream::scenes
