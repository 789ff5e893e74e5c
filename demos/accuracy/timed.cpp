// SPDX-License-Identifier: MIT
#include "timed.hpp"

#include "measure/clock.hpp"
#include "measure/interleave.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::accuracy {

double timed(scenes::Scene scene, const std::string& broadphase, std::uint64_t steps) {
  const auto clock = scene.broadphase.threads > 1 ? measure::Clock::wall : measure::Clock::cpu;
  const double seconds = static_cast<double>(steps) * scene.time.dt;
  scene.checks.clear();
  scenes::Simulation simulation(scene, broadphase);
  const auto run = [&] {
    for (std::uint64_t step = 0; step < steps; ++step) simulation.advance();
  };
  return measure::time_once(run, clock) / seconds;
}

}  // namespace boxstream::accuracy
