// SPDX-License-Identifier: MIT
#include "machine.hpp"

#include <LinearMath/btScalar.h>
#include <fmt/format.h>

#include <boxstream/version.hpp>
#include <fstream>

namespace boxstream::tool {

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t value = line.find_first_not_of(" \t", line.find(':') + 1);
    if (value != std::string::npos) return line.substr(value);
  }
  return "unknown";
}

std::string compiler_name() {
#if defined(__clang__)
  return "clang " __clang_version__;
#elif defined(__GNUC__)
  return "gcc " __VERSION__;
#else
  return "unknown";
#endif
}

std::string boxstream_version() {
  return fmt::format("{}.{}.{}", BOXSTREAM_VERSION_MAJOR, BOXSTREAM_VERSION_MINOR, BOXSTREAM_VERSION_PATCH);
}

std::string bullet_version() {
  return fmt::format("{}.{:02}", btGetVersion() / 100, btGetVersion() % 100);
}

}  // namespace boxstream::tool
