// SPDX-License-Identifier: MIT
#include "machine.hpp"

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include <boxstream/detector.hpp>
#include <boxstream/version.hpp>

namespace boxstream::bench {

namespace {

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown CPU";
}

std::string compiler() {
#if defined(__clang__)
  return "clang " __clang_version__;
#elif defined(__GNUC__)
  return "g++ " __VERSION__;
#else
  return "unknown compiler";
#endif
}

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
  return value ? value : "";
}

}  // namespace

Machine describe_machine() {
  const std::string version = std::to_string(BOXSTREAM_VERSION_MAJOR) + '.' + std::to_string(BOXSTREAM_VERSION_MINOR) +
                              '.' + std::to_string(BOXSTREAM_VERSION_PATCH);
  return {cpu_model(),
          std::thread::hardware_concurrency(),
          compiler(),
          BOXSTREAM_BENCH_FLAGS,
          BOXSTREAM_BENCH_PEER_FLAGS,
          simd_target(),
          utc_now(),
          version,
          load_average(),
          commit()};
}

}  // namespace boxstream::bench
