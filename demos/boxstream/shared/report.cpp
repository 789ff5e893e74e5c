// SPDX-License-Identifier: MIT
#include "boxstream/shared/report.hpp"

#include <LinearMath/btScalar.h>
#include <fmt/format.h>
#include <boxstream/detector.hpp>

#include <utility>

namespace boxstream::tool {

std::string bullet_version() {
  return fmt::format("{}.{:02}", btGetVersion() / 100, btGetVersion() % 100);
}

std::string versions() {
  return fmt::format("boxstream {}, Bullet {}", measure::library_version(), bullet_version());
}

nlohmann::ordered_json report_about(nlohmann::ordered_json about) {
  about.update({{"boxstream", measure::library_version()},
                {"simd", simd_target()},
                {"compiler", measure::compiler_name()},
                {"cpu", measure::cpu_name()}});
  return {{"format", 1}, {"meta", std::move(about)}};
}

}  // namespace boxstream::tool
