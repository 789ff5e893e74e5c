// SPDX-License-Identifier: MIT
#include "measure/stopwatch.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
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

namespace boxstream::measure {
namespace {

/// Callgrind numbers its dumps, and each ends in what all its functions took together.
class Dumps {
 public:
  double sum() const { return sum_; }

  void take() {
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

double time_once(const std::function<void()>& region, Clock clock) {
  const bool is_counted = !std::isnan(counted_instructions());
  if (is_counted) {
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
  }
  const auto start = now(clock);
  region();
  const auto end = now(clock);
  if (is_counted) {
    CALLGRIND_DUMP_STATS;
    CALLGRIND_STOP_INSTRUMENTATION;
    dumps().take();
  }
  return milliseconds(end - start);
}

double counted_instructions() {
  return dumps().sum();
}

bool InterruptionMonitor::interrupted() const {
  const double wall = wall_.milliseconds(), lost = wall - milliseconds(now() - thread_);
  return lost > 0.02 * wall && lost > 0.1;
}

}  // namespace boxstream::measure
