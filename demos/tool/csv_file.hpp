// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "onlooker.hpp"
#include "output_file.hpp"
#include "scene/checks.hpp"
#include "simulate.hpp"

namespace boxstream::tool {

/// A table with a row for each step of the world asked for: its pairs and times, and what its bodies did.
class CsvFile final : public Onlooker {
 public:
  /// Throws BadInput as OutputFile does.
  explicit CsvFile(const std::string& path) : file_(path) {}

  void begin(const scenes::Simulation&, std::uint64_t steps) override { rows_.reserve(steps); }
  void after_pairs(const scenes::Simulation&) override {}
  void after_step(const scenes::Simulation& simulation) override;

  /// Throws std::runtime_error if it could not be written.
  void write(const RunResult& result) const;
  const OutputFile& file() const { return file_; }
  void commit() { file_.commit(); }

 private:
  using Metric = scenes::Check::Metric;
  static constexpr std::array metrics{Metric::energy,   Metric::momentum, Metric::max_speed, Metric::max_penetration,
                                      Metric::residual, Metric::sleeping, Metric::lowest};

  OutputFile file_;
  std::vector<std::array<double, metrics.size()>> rows_;
};

}  // namespace boxstream::tool
