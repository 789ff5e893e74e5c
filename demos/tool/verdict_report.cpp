// SPDX-License-Identifier: MIT
#include "verdict_report.hpp"

#include <fmt/format.h>

namespace boxstream::tool {
namespace {

std::string outcome(const scenes::Verdict& verdict) {
  if (!verdict.asked) return "not asked: the run was too short";
  return fmt::format("{}: {:.6g} after step {}", verdict.passed ? "passed" : "FAILED", verdict.value, verdict.step);
}

}  // namespace

std::string check_text(const scenes::Check& check) {
  const std::string when = check.at_end    ? "at the end"
                           : check.at == 0 ? "always"
                                           : fmt::format("after step {}", check.at);
  return fmt::format("{} {} {:g}, {}", name_of(check.metric), name_of(check.op), check.value, when);
}

std::string verdict_lines(const scenes::Scene& scene, const RunResult& result) {
  std::string out;
  for (const scenes::Verdict& verdict : result.worlds.front().simulation->verdicts())
    out += fmt::format("{:<14}{}: {}\n", "check", check_text(scene.checks[verdict.check]), outcome(verdict));
  return out;
}

std::string first_failed_check(const scenes::Scene& scene, const RunResult& result) {
  for (const WorldRun& world : result.worlds)
    for (const scenes::Verdict& verdict : world.simulation->verdicts())
      if (!verdict.passed)
        return fmt::format("check failed on {}: {} ({})", world.broadphase, check_text(scene.checks[verdict.check]),
                           outcome(verdict));
  return {};
}

}  // namespace boxstream::tool
