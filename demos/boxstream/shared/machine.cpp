// SPDX-License-Identifier: MIT
#include "boxstream/shared/machine.hpp"

#include <LinearMath/btScalar.h>
#include <fmt/format.h>

#include "measure/machine.hpp"

namespace boxstream::tool {

std::string cpu_name() {
  return measure::cpu_name();
}

std::string compiler_name() {
  return measure::compiler_name();
}

std::string boxstream_version() {
  return measure::library_version();
}

std::string bullet_version() {
  return fmt::format("{}.{:02}", btGetVersion() / 100, btGetVersion() % 100);
}

}  // namespace boxstream::tool
