// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace boxstream::scenes {

/// A criterion that a run passes or fails.
struct Check {
  enum class Metric {
    missed_pairs,     // overlapping boxes that the broad-phase does not hold, over all steps
    finite,           // 1 if every coordinate and velocity is finite, else 0
    outside,          // dynamic bodies whose centre is out of bounds
    max_penetration,  // metres, deepest contact
    energy,           // J, kinetic and potential, of all dynamic bodies and springs
    energy_drift,     // |energy - energy at the start| / Simulation::energy_scale() at the start
    momentum,         // kg m/s
    max_speed,        // m/s
    residual,         // the solver's, largest squared change of an impulse in its last iteration
    sleeping,         // dynamic bodies that sleep
    pairs,            // held by the broad-phase
    lowest,           // m, y of the lowest centre of a dynamic body
    highest           // m, y of the highest one
  };
  enum class Op { less, at_most, equal, at_least, greater };

  Metric metric = Metric::finite;
  Op op = Op::equal;
  double value = 0;
  std::uint64_t at = 0;  // the step after which it is evaluated; 0: after every one
  bool at_end = false;   // after the last one instead
};

/// As scenes write them, in the order of the enumerations.
const std::vector<std::string>& metric_names();
const std::vector<std::string>& op_names();

const char* name_of(Check::Metric metric);
const char* name_of(Check::Op op);

}  // namespace boxstream::scenes
