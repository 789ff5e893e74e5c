// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <ctime>
#include <functional>

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
