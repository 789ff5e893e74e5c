// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

class btRigidBody;

namespace boxstream::scenes {

/// Called in each step with its length, in seconds. Each may be null, and must not throw.
struct MotionHooks {
  std::function<void(double)> before_solver;  ///< forces and damping are in, contacts are found
  std::function<void(double)> before_motion;  ///< the solver is done and bodies have not moved yet
  std::function<void(double)> after_motion;
  /// What follows the energy of bodies: something but gravity, and a force on it, is about to change the motion of this
  /// one. May be called for a body that then is not changed, and more than once.
  std::function<void(const btRigidBody&)> acting_on;
};

}  // namespace boxstream::scenes
