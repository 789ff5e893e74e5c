// SPDX-License-Identifier: MIT
#pragma once

#include "sweep.hpp"

namespace boxstream::accuracy {

/// Runs a scene for `row.steps` steps, samples it after each, and fills in the series, values, vitals, cost and failure
/// of `row`. If `trajectory` is given, it is filled in too. False if the request said stop before the end: then `row`
/// says nothing.
bool run_and_sample(const Request& request, const scenes::Scene& scene, const Reference& reference, Row& row,
                    Trajectory* trajectory = nullptr);

}  // namespace boxstream::accuracy
