// SPDX-License-Identifier: MIT
#include "measure/machine.hpp"

#include <sys/resource.h>
#include <unistd.h>
#include <boxstream/detector.hpp>
#include <boxstream/version.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#include "measure/stopwatch.hpp"

namespace boxstream::measure {
namespace {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

std::string commit() {
  const char* const value = std::getenv("BOXSTREAM_COMMIT");
  return value != nullptr ? value : "";
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Of this process, and of its children that have ended.
double own_seconds() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  return sum;
}

/// By the first line of /proc/stat: user, nice, system, idle, waiting for disks, interrupts (two), stolen.
double busy_seconds() {
  std::ifstream stat("/proc/stat");
  std::string name;
  double ticks[8] = {};
  stat >> name;
  for (double& tick : ticks) stat >> tick;
  if (!stat) return NAN;
  double sum = 0;
  for (const int i : {0, 1, 2, 5, 6, 7}) sum += ticks[i];
  return sum / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t value = line.find_first_not_of(" \t", line.find(':') + 1);
    if (line.starts_with("model name") && value != std::string::npos) return line.substr(value);
  }
  return "unknown CPU";
}

std::string compiler_name() {
#if defined(__clang__)
  return "clang " __clang_version__;
#elif defined(__GNUC__)
  return "g++ " __VERSION__;
#else
  return "unknown compiler";
#endif
}

std::string library_version() {
  return std::to_string(BOXSTREAM_VERSION_MAJOR) + '.' + std::to_string(BOXSTREAM_VERSION_MINOR) + '.' +
         std::to_string(BOXSTREAM_VERSION_PATCH);
}

Machine describe_machine() {
  return {.cpu = cpu_name(),
          .hardware_threads = std::thread::hardware_concurrency(),
          .compiler = compiler_name(),
          .flags = BOXSTREAM_MEASURE_FLAGS,
          .peer_flags = BOXSTREAM_MEASURE_FLAGS,
          .simd = simd_target(),
          .date = utc_now(),
          .load = load_average(),
          .version = library_version(),
          .commit = commit()};
}

nlohmann::ordered_json to_json(const Machine& machine) {
  return {{"cpu", machine.cpu},
          {"hardware_threads", machine.hardware_threads},
          {"compiler", machine.compiler},
          {"flags", machine.flags},
          {"peer_flags", machine.peer_flags},
          {"simd", machine.simd},
          {"date", machine.date},
          {"load", machine.load},
          {"boxstream", machine.version},
          {"commit", machine.commit}};
}

OtherLoad::Spent OtherLoad::now() {
  return {1e-9 * static_cast<double>(measure::now(Clock::wall).count()), busy_seconds(), own_seconds()};
}

double OtherLoad::processors() const {
  const Spent end = now();
  const double others = (end.busy - start_.busy) - (end.own - start_.own);
  // Ticks are coarser than the times of a process.
  return std::isnan(others) ? NAN : std::max(0.0, others / (end.elapsed - start_.elapsed));
}

}  // namespace boxstream::measure
