// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "boxstream/advice/coarse_steps.hpp"
#include "boxstream/advice/hard_cases.hpp"
#include "simulation/run/start_overlaps.hpp"

namespace boxstream::tool {

/// What the settings of a scene are known to get wrong, before it runs.
struct Warnings {
  scenes::StartOverlaps overlaps;
  std::string overlap;             ///< `overlaps` in one line; empty: there are none
  std::vector<std::string> wrong;  ///< what will be wrong however effects are set
  std::vector<HardCase> hard;      ///< worlds that are known to be hard
  std::vector<CoarseStep> coarse;  ///< steps that are too coarse for what is known by closed forms

  /// Each in one line, as "hard: a chain of ...; a world at least as hard held ...".
  std::vector<std::string> lines() const;
};

/// Throws SceneError for a shape that cannot be built.
Warnings warnings_of(const scenes::Scene& scene);

}  // namespace boxstream::tool
