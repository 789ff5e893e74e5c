// SPDX-License-Identifier: MIT
#include "stopwatch.hpp"

#include <ctime>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS
#endif

namespace boxstream::accuracy {
namespace {

double milliseconds(clockid_t clock) {
  std::timespec now{};
  clock_gettime(clock, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double stopwatch(const std::function<void()>& region, Clock clock) {
  const clockid_t id = clock == Clock::cpu ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
  CALLGRIND_ZERO_STATS;
  const double start = milliseconds(id);
  region();
  const double end = milliseconds(id);
  CALLGRIND_DUMP_STATS;
  return end - start;
}

}  // namespace boxstream::accuracy
