// SPDX-License-Identifier: MIT
#include "boxstream/simulate/check_report.hpp"

#include <fmt/format.h>

namespace boxstream::tool {
namespace {

std::string outcome(const scenes::CheckResult& result) {
  if (!result.asked) return "not evaluated: the run was too short";
  return fmt::format("{}: {:.6g} after step {}", result.passed ? "passed" : "FAILED", result.value, result.step);
}

}  // namespace

std::string check_text(const scenes::Check& check) {
  const std::string when = check.at_end    ? "at the end"
                           : check.at == 0 ? "always"
                                           : fmt::format("after step {}", check.at);
  return fmt::format("{} {} {:g}, {}", name_of(check.metric), name_of(check.op), check.value, when);
}

std::string check_lines(const scenes::Scene& scene, const RunResult& result) {
  std::string out;
  for (const scenes::CheckResult& check : result.worlds.front().simulation->check_results())
    out += fmt::format("{:<14}{}: {}\n", "check", check_text(scene.checks[check.check]), outcome(check));
  return out;
}

std::string first_failed_check(const scenes::Scene& scene, const RunResult& result) {
  for (const WorldRun& world : result.worlds)
    for (const scenes::CheckResult& check : world.simulation->check_results())
      if (!check.passed)
        return fmt::format("check failed on {}: {} ({})", world.broadphase, check_text(scene.checks[check.check]),
                           outcome(check));
  return {};
}

}  // namespace boxstream::tool
