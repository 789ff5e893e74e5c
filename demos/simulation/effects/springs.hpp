// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "simulation/effects/effect.hpp"

namespace boxstream::effects {

/// A spring that oscillates too fast for the substeps of its scene. Bullet softens one whose phase advances by more
/// than a quarter of a radian in a substep: its period is 25 substeps then, whatever its stiffness.
struct StiffSpring {
  std::size_t joint;  ///< index into the expanded joints
  double stiffness;   ///< N/m
  double mass;        ///< kg, of its ends against each other
  double swing;       ///< seconds that it should take
  double shown;       ///< seconds that it takes
  int substeps;       ///< that make it as stiff as it is
};

/// The fastest of a scene that Bullet makes softer, if there is one. `masses` is of each body, 0 if it is not dynamic.
std::optional<StiffSpring> stiffest_spring(const Subject& subject, const std::vector<double>& masses);

}  // namespace boxstream::effects
