// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "simulation/run/simulation.hpp"

namespace boxstream::tool {

/// Looks on while a world runs, and must change nothing in it. None of its time is counted.
class Monitor {
 public:
  virtual ~Monitor() = default;

  /// Before the first of `steps` steps.
  virtual void begin(const scenes::Simulation& simulation, std::uint64_t steps) = 0;
  /// Within a step, each time right after calculateOverlappingPairs: the one moment when pairs and boxes agree.
  virtual void after_pairs(const scenes::Simulation& simulation) = 0;
  virtual void after_step(const scenes::Simulation& simulation) = 0;
};

}  // namespace boxstream::tool
