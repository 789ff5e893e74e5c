// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/output_file.hpp"
#include "boxstream/simulate/monitor.hpp"
#include "boxstream/simulate/simulate.hpp"
#include "formats/scene_model/checks.hpp"

namespace boxstream::tool {

/// A table with a row for each step of the world asked for: its pairs and times, and what its bodies did.
class CsvFile final : public Monitor {
 public:
  /// Throws as files::OutputFile does.
  explicit CsvFile(const std::string& path) : file_(path) {}

  void begin(const scenes::Simulation&, std::uint64_t steps) override { rows_.reserve(steps); }
  void after_pairs(const scenes::Simulation&) override {}
  void after_step(const scenes::Simulation& simulation) override;

  void write(const RunResult& result);
  void commit() { file_.commit(); }

 private:
  using Metric = scenes::Check::Metric;
  static constexpr std::array metrics{Metric::energy,   Metric::momentum, Metric::max_speed, Metric::max_penetration,
                                      Metric::residual, Metric::sleeping, Metric::lowest};

  files::OutputFile file_;
  std::vector<std::array<double, metrics.size()>> rows_;
};

}  // namespace boxstream::tool
