// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "measure/clock.hpp"

namespace boxstream::measure {

/// Milliseconds that one call of `region` takes. Regions do not nest where instructions are counted.
double time_once(const std::function<void()>& region, Clock clock = Clock::cpu);

/// Instructions of all regions so far, on all threads. NaN unless the program runs under callgrind with
/// `--instr-atstart=no --callgrind-out-file=FILE` and the environment has BOXSTREAM_CALLGRIND=FILE: then the regions
/// alone are counted, and what is around them costs little more than without.
double counted_instructions();

/// Detects whether the calling thread was interrupted since this object was made.
class InterruptionMonitor {
 public:
  /// True if the thread did not run for more than a fiftieth of the time, and more than 0.1 ms.
  bool interrupted() const;

 private:
  Elapsed wall_;
  std::chrono::nanoseconds thread_ = now();
};

}  // namespace boxstream::measure
