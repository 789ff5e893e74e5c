// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace boxstream::scenes {

/// Called in each step with its length, in seconds. Each may be null, and must not throw.
struct MotionHooks {
  std::function<void(double)> before_solver;  ///< forces and damping are in, contacts are found
  std::function<void(double)> before_motion;  ///< the solver is done and bodies have not moved yet
  std::function<void(double)> after_motion;
};

}  // namespace boxstream::scenes
