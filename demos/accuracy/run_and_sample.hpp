// SPDX-License-Identifier: MIT
#pragma once

#include "sweep.hpp"

namespace boxstream::accuracy {

/// The trajectory that others are compared with.
struct Reference {
  Trajectory trajectory;
  double dt = 0;  ///< between its frames
};

/// Runs a scene for `row.steps` steps, samples it after each, and fills in the series, values and failure of `row`.
void run_and_sample(const Request& request, const scenes::Scene& scene, const Reference& reference, Row& row);

}  // namespace boxstream::accuracy
