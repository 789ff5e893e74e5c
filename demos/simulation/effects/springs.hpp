// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "simulation/effects/effect.hpp"

namespace boxstream::effects {

/// A spring that swings too fast for the substeps of its scene. Bullet makes one softer that turns by more than a
/// quarter of a radian in a substep: it swings in 25 of them then, whatever its stiffness.
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
