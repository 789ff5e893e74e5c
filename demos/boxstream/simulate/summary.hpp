// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "simulation/run/simulation.hpp"

namespace boxstream::tool {

/// The parts of a step that are reported, in order: broad-phase, dispatch, their sum, the whole step.
struct Phase {
  const char* name;
  const char* json_name;
  double (*time_ms)(const scenes::StepResult&);
};
const std::vector<Phase>& phases();

std::vector<double> times_ms(const std::vector<scenes::StepResult>& steps, const Phase& phase);

struct Times {
  double median_ms = 0;
  double min_ms = 0;
  double total_ms = 0;
};
/// All zero for no steps.
Times summarize(std::vector<double> times);

/// One line if the steps waited for the processor for long, else nothing.
std::string lost_time(const std::vector<scenes::StepResult>& steps);

}  // namespace boxstream::tool
