// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "simulation/run/simulation.hpp"

namespace boxstream::view {

/// One world of a run.
struct TracedWorld {
  std::string broadphase;
  const std::vector<scenes::StepResult>* steps;
};

/// A run as trace events (JSON), for Perfetto and chrome://tracing: a process for each world, in it a track of steps
/// with their phases, and counters. How long each step and phase took was measured; when they began was not. So steps
/// follow each other without gaps, and within a step the phases stand in the order in which Bullet runs them, and
/// "rest", which is what else the step took (forces, islands, integration), at the end.
void write_trace(std::ostream& out, const scenes::Scene& scene, const std::vector<TracedWorld>& worlds,
                 const std::string& versions);

}  // namespace boxstream::view
