// SPDX-License-Identifier: MIT
#include "boxstream/shared/machine.hpp"

#include <LinearMath/btScalar.h>
#include <fmt/format.h>

namespace boxstream::tool {

std::string bullet_version() {
  return fmt::format("{}.{:02}", btGetVersion() / 100, btGetVersion() % 100);
}

std::string versions() {
  return fmt::format("boxstream {}, Bullet {}", measure::library_version(), bullet_version());
}

}  // namespace boxstream::tool
