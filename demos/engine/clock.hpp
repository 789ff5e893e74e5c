// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <ctime>

namespace boxstream::scenes {

/// `cpu`: processor time of the calling thread, which other programs on the machine do not lengthen. `wall`: elapsed
/// time, for work on several threads.
enum class Clock { cpu, wall };

/// Reading `cpu` takes a system call: some hundred nanoseconds.
inline std::chrono::nanoseconds now(Clock clock = Clock::cpu) {
  std::timespec time{};
  clock_gettime(clock == Clock::cpu ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

inline double milliseconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

}  // namespace boxstream::scenes
