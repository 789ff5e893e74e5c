// SPDX-License-Identifier: MIT
#pragma once

#include "measure/stopwatch.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::report {

/// Milliseconds for each simulated second of the steps that the scene asks for.
inline double ms_per_simulated_second(scenes::Simulation& simulation) {
  const scenes::Time& time = simulation.scene().time;
  const auto run = [&] {
    for (int step = 0; step < time.steps; ++step) simulation.advance();
  };
  return measure::time_once(run) / (time.steps * time.dt);
}

}  // namespace boxstream::report
