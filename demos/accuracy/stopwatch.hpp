// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace boxstream::accuracy {

/// `cpu`: processor time of the calling thread, which other programs on the machine do not lengthen. `wall`: elapsed
/// time, for work on several threads.
enum class Clock { cpu, wall };

/// Milliseconds that `region` takes. Under callgrind the instructions of this region alone are dumped, too: one dump a
/// call.
double stopwatch(const std::function<void()>& region, Clock clock = Clock::cpu);

}  // namespace boxstream::accuracy
