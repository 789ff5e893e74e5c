// SPDX-License-Identifier: MIT
#include "simulation/effects/springs.hpp"

#include <cmath>
#include <numbers>

namespace boxstream::effects {

std::optional<StiffSpring> stiffest_spring(const Subject& subject, const std::vector<double>& masses) {
  // Radians of its swing in a substep beyond which Bullet makes a spring softer.
  constexpr double most_angle = 0.25;
  const scenes::Time& time = subject.scene.time;
  const double substep = time.dt / time.substeps;
  std::optional<StiffSpring> stiffest;
  for (std::size_t i = 0; i < subject.expanded.joints.size(); ++i) {
    const scenes::Joint& joint = subject.expanded.joints[i];
    const auto* const spring = std::get_if<scenes::SpringJoint>(&joint.value);
    if (spring == nullptr) continue;
    const double a = masses[joint.a], b = joint.b ? masses[*joint.b] : 0;
    const double lightness = (a > 0 ? 1 / a : 0) + (b > 0 ? 1 / b : 0);
    const double rate = std::sqrt(spring->stiffness * lightness);
    if (!(rate * substep > most_angle)) continue;
    const double swing = 2 * std::numbers::pi / rate;
    if (stiffest && stiffest->swing <= swing) continue;
    stiffest = StiffSpring{i,
                           spring->stiffness,
                           1 / lightness,
                           swing,
                           2 * std::numbers::pi * substep / most_angle,
                           static_cast<int>(std::ceil(rate * time.dt / most_angle))};
  }
  return stiffest;
}

}  // namespace boxstream::effects
