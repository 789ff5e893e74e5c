// SPDX-License-Identifier: MIT
#include "boxstream/advice/warnings.hpp"

#include <fmt/format.h>

#include "boxstream/shared/start_overlap_text.hpp"
#include "simulation/effects/unfit.hpp"

namespace boxstream::tool {

Warnings warnings_of(const scenes::Scene& scene) {
  Warnings found;
  found.overlaps = scenes::overlaps_at_start(scene);
  found.overlap = start_overlap_text(scene, found.overlaps);
  found.wrong = effects::unfit(scene);
  found.hard = hard_cases(scene);
  found.coarse = coarse_steps(scene);
  return found;
}

std::vector<std::string> Warnings::lines() const {
  std::vector<std::string> all;
  if (!overlap.empty()) all.push_back("overlap: " + overlap);
  for (const std::string& each : wrong) all.push_back("wrong: " + each);
  for (const HardCase& each : hard) all.push_back(fmt::format("hard: {}; {}", each.what, each.advice));
  for (const CoarseStep& each : coarse) all.push_back(fmt::format("coarse: {}; {}", each.what, each.advice));
  return all;
}

}  // namespace boxstream::tool
