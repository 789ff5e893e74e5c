// SPDX-License-Identifier: MIT
#include "boxstream/simulate/document_of.hpp"

#include <cstdint>
#include <optional>

#include "boxstream/shared/print.hpp"
#include "boxstream/simulate/json_report.hpp"
#include "boxstream/simulate/simulate.hpp"

namespace boxstream::tool {

nlohmann::json document_of(const scenes::Scene& scene, const std::string& broadphase) {
  StatusLine quiet;
  const RunResult result = run(scene, broadphase, std::nullopt, static_cast<std::uint64_t>(scene.time.steps), quiet);
  return nlohmann::json::parse(result_json(scene, result));
}

}  // namespace boxstream::tool
