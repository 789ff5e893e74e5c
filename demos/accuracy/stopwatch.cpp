// SPDX-License-Identifier: MIT
#include "stopwatch.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS
#define RUNNING_ON_VALGRIND 0
#endif

namespace boxstream::accuracy {
namespace {

double milliseconds(clockid_t clock) {
  std::timespec now{};
  clock_gettime(clock, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Callgrind numbers its dumps, and each ends in what all its functions took together.
class Dumps {
 public:
  double sum() const { return sum_; }

  void take() {
    if (std::isnan(sum_)) return;
    const std::string file = base_ + "." + std::to_string(++taken_);
    std::ifstream stream(file);
    double count = NAN;
    for (std::string line; std::getline(stream, line);)
      if (line.rfind("totals: ", 0) == 0) count = std::strtod(line.c_str() + 8, nullptr);
    sum_ += count;
    std::remove(file.c_str());
  }

 private:
  static std::string base() {
    const char* const name = std::getenv("BOXSTREAM_CALLGRIND");
    return name != nullptr && RUNNING_ON_VALGRIND != 0 ? name : "";
  }

  std::string base_ = base();
  double sum_ = base_.empty() ? NAN : 0;
  int taken_ = 0;
};

Dumps& dumps() {
  static Dumps all;
  return all;
}

}  // namespace

double stopwatch(const std::function<void()>& region, Clock clock) {
  const clockid_t id = clock == Clock::cpu ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  const double start = milliseconds(id);
  region();
  const double end = milliseconds(id);
  CALLGRIND_DUMP_STATS;
  CALLGRIND_STOP_INSTRUMENTATION;
  dumps().take();
  return end - start;
}

double counted_instructions() {
  return dumps().sum();
}

}  // namespace boxstream::accuracy
