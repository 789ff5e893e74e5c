// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/windward.hpp"

namespace boxstream::effects {

/// Air or a fluid of uniform velocity, which pushes bodies in proportion to the area that faces the flow.
class Flow {
 public:
  /// `density` in kg/m^3, and a coefficient of drag.
  Flow(SceneInstance& instance, const btVector3& velocity, double density, double coefficient);

  /// A force and a torque on each dynamic body, for a substep of `dt` seconds.
  void push(double dt) const;

 private:
  const SceneInstance& instance_;
  btVector3 velocity_;
  double factor_;  // half the density and the coefficient
  std::vector<std::shared_ptr<const scenes::Windward>> surfaces_;
};

}  // namespace boxstream::effects
