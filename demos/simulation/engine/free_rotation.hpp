// SPDX-License-Identifier: MIT
#pragma once

#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

/// How a rigid body turns while no torque acts on it: Euler's equations along its principal axes.
///
/// Gauss's collocation with two stages, in parts of a step that turn the body by a fifth of a radian at most: of fourth
/// order, and energy and momentum, being quadratic, stay to the rounding of double numbers, however long it tumbles.
class FreeRotation {
 public:
  /// Moments of inertia about the principal axes, kg m^2, all above 0.
  explicit FreeRotation(const Vec3& moments);

  struct State {
    Vec3 spin;      ///< rad/s, along the body's own axes
    Quat rotation;  ///< of the body in the world; of length 1 but for rounding
  };
  /// Turns a body for `dt` seconds. Its momentum in the world stays what it is. One that turns by more than 51 rad in
  /// this time, or whose spin is not a number, is left as it is: false.
  bool advance(double dt, State& state) const;

  /// Angular momentum in the world.
  Vec3 momentum(const State& state) const;

 private:
  Vec3 moments_;
  Vec3 ratios_;       // of the differences of two moments to the third
  double stiffness_;  // the largest ratio, 1 at least: that of solid bodies is never larger
};

}  // namespace boxstream::scenes
