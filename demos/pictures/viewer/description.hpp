// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pictures/viewer/model.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::view {

/// All of a run but its frames.
struct Description {
  const scenes::Scene& scene;
  const std::string& broadphase;
  const std::string& versions;
  const Model& model;
  float unit;
  const std::vector<std::uint64_t>& frame_steps;
  const std::vector<scenes::StepResult>& results;
  std::size_t blocks;
};

/// As JSON, for the viewer: title, about, dt, unit, the forms and parts of the model, the step of each frame, and
/// numbers and times of every step.
std::string describe(const Description& description);

}  // namespace boxstream::view
