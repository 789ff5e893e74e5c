// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <ctime>

namespace boxstream::measure {

/// `cpu`: processor time of the calling thread. For work on one thread this is what a wall clock shows on an idle
/// machine; on a busy one elapsed time penalises runs that are longer than a time slice, which distorts ratios.
/// `wall`: elapsed time, for work on several threads.
enum class Clock { cpu, wall };

/// "cpu" or "wall".
inline const char* clock_name(Clock clock) {
  return clock == Clock::cpu ? "cpu" : "wall";
}

/// Reading `cpu` takes a system call: some hundred nanoseconds.
inline std::chrono::nanoseconds now(Clock clock = Clock::cpu) {
  std::timespec time{};
  clock_gettime(clock == Clock::cpu ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

inline double milliseconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

/// Elapsed time since this object was made.
class Elapsed {
 public:
  double milliseconds() const { return measure::milliseconds(now(Clock::wall) - start_); }
  double seconds() const { return milliseconds() / 1000; }

 private:
  std::chrono::nanoseconds start_ = now(Clock::wall);
};

}  // namespace boxstream::measure
