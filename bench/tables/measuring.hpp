// SPDX-License-Identifier: MIT
#pragma once

#include "measure/interleave.hpp"
#include "measure/machine.hpp"
#include "measure/progress.hpp"

/// The benchmark's names for what is shared with all that measures.
namespace boxstream::bench {

using measure::Clock;
using measure::clock_name;
using measure::Contestant;
using measure::describe_machine;
using measure::Elapsed;
using measure::Interleaving;
using measure::InterruptionMonitor;
using measure::Machine;
using measure::measure_interleaved;
using measure::Progress;
using measure::Series;
using measure::summarize;
using measure::time_once;

}  // namespace boxstream::bench
