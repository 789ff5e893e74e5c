// SPDX-License-Identifier: MIT
#include "boxstream/simulate/csv_file.hpp"

#include <fmt/format.h>

#include <iterator>

namespace boxstream::tool {

void CsvFile::after_step(const scenes::Simulation& simulation) {
  auto& row = rows_.emplace_back();
  for (std::size_t i = 0; i < metrics.size(); ++i) row[i] = simulation.metric(metrics[i]);
}

void CsvFile::write(const RunResult& result) {
  std::string text =
      "step,bodies,pairs,begun,ended,ghost_overlaps,update_aabbs_ms,overlapping_pairs_ms,dispatch_ms,solve_ms,step_ms,"
      "state_hash";
  for (const Metric metric : metrics) text += fmt::format(",{}", name_of(metric));
  text += "\n";
  const auto to = std::back_inserter(text);
  const std::vector<scenes::StepResult>& steps = result.worlds.front().steps;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const scenes::StepResult& s = steps[i];
    fmt::format_to(to, "{},{},{},{},{},{},{},{},{},{},{},{:016x}", s.step, s.bodies, s.pairs, s.begun, s.ended,
                   s.ghost_overlaps, s.update_aabbs_ms, s.overlapping_pairs_ms, s.dispatch_ms, s.solve_ms, s.step_ms,
                   s.state_hash);
    for (const double value : rows_[i]) fmt::format_to(to, ",{}", value);
    text += "\n";
  }
  file_.stream() << text;
}

}  // namespace boxstream::tool
