// SPDX-License-Identifier: MIT
#include "boxstream/simulate/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "measure/interleave.hpp"

namespace boxstream::tool {

using scenes::StepResult;

const std::vector<Phase>& phases() {
  static const std::vector<Phase> all{
      {"broad-phase", "broadphase", [](const StepResult& s) { return s.broadphase_ms; }},
      {"dispatch", "dispatch", [](const StepResult& s) { return s.dispatch_ms; }},
      {"sum of both", "sum", [](const StepResult& s) { return s.broadphase_ms + s.dispatch_ms; }},
      {"whole step", "step", [](const StepResult& s) { return s.step_ms; }}};
  return all;
}

std::vector<double> times_ms(const std::vector<StepResult>& steps, const Phase& phase) {
  std::vector<double> times(steps.size());
  std::transform(steps.begin(), steps.end(), times.begin(), phase.time_ms);
  return times;
}

Times summarize(std::vector<double> times) {
  if (times.empty()) return {};
  std::sort(times.begin(), times.end());  // so that the sum does not depend on the order
  return {measure::median(times), times.front(), std::accumulate(times.begin(), times.end(), 0.0)};
}

std::string lost_time(const std::vector<StepResult>& steps) {
  double lost = 0, busy = 0;
  for (const StepResult& step : steps) {
    lost += step.lost_ms;
    busy += step.step_ms;
  }
  if (lost < 100 || lost < busy / 4) return {};
  return fmt::format(
      "the machine was busy: steps took {:.0f} ms of processor time and waited {:.0f} ms beside it; compare such times "
      "with care",
      busy, lost);
}

}  // namespace boxstream::tool
