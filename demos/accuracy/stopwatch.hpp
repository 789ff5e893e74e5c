// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace boxstream::accuracy {

/// `cpu`: processor time of the calling thread, which other programs on the machine do not lengthen. `wall`: elapsed
/// time, for work on several threads.
enum class Clock { cpu, wall };

/// Milliseconds that `region` takes. Regions do not nest.
double stopwatch(const std::function<void()>& region, Clock clock = Clock::cpu);

/// Instructions of all regions so far, on all threads. NaN unless the program runs under callgrind with
/// `--instr-atstart=no --callgrind-out-file=FILE` and the environment has BOXSTREAM_CALLGRIND=FILE: then the regions
/// alone are counted, and what is around them costs little more than without.
double counted_instructions();

}  // namespace boxstream::accuracy
