// SPDX-License-Identifier: MIT
#include "stopwatch.hpp"

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

namespace boxstream::accuracy {
namespace {

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
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  const auto start = scenes::now(clock);
  region();
  const auto end = scenes::now(clock);
  CALLGRIND_DUMP_STATS;
  CALLGRIND_STOP_INSTRUMENTATION;
  dumps().take();
  return scenes::milliseconds(end - start);
}

double counted_instructions() {
  return dumps().sum();
}

}  // namespace boxstream::accuracy
