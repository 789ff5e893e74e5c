// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "engine/clock.hpp"

namespace boxstream::accuracy {

using scenes::Clock;

/// Milliseconds that `region` takes. Regions do not nest.
double stopwatch(const std::function<void()>& region, Clock clock = Clock::cpu);

/// Instructions of all regions so far, on all threads. NaN unless the program runs under callgrind with
/// `--instr-atstart=no --callgrind-out-file=FILE` and the environment has BOXSTREAM_CALLGRIND=FILE: then the regions
/// alone are counted, and what is around them costs little more than without.
double counted_instructions();

}  // namespace boxstream::accuracy
