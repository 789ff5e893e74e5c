// SPDX-License-Identifier: MIT
#include "boxstream/shared/report.hpp"

#include <utility>

#include <boxstream/detector.hpp>

#include "measure/machine.hpp"

namespace boxstream::tool {

nlohmann::ordered_json report_about(nlohmann::ordered_json about) {
  about.update({{"boxstream", measure::library_version()},
                {"simd", simd_target()},
                {"compiler", measure::compiler_name()},
                {"cpu", measure::cpu_name()}});
  return {{"format", 1}, {"meta", std::move(about)}};
}

}  // namespace boxstream::tool
