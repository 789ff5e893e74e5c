// SPDX-License-Identifier: MIT
#pragma once

#include "sweep.hpp"

namespace boxstream::accuracy {

/// What trajectories are measured against.
struct Yardstick {
  Track track;
  double dt = 0;  ///< between its frames
};

/// Runs a scene for `row.steps` steps, looks at it after each, and fills in what was found: series, values and failure.
void look(const Request& request, const scenes::Scene& scene, const Yardstick& yardstick, Row& row);

}  // namespace boxstream::accuracy
