// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/output_file.hpp"
#include "boxstream/simulate/monitor.hpp"

namespace boxstream::tool {

/// A table with a row for each body that is not fixed, before the first step and after each: where it is, how it is
/// turned (x, y, z, w), how its centre of mass moves and how it spins.
class StatesFile final : public Monitor {
 public:
  /// Throws as files::OutputFile does.
  explicit StatesFile(const std::string& path);

  void begin(const scenes::Simulation& simulation, std::uint64_t) override { write(simulation); }
  void after_pairs(const scenes::Simulation&) override {}
  void after_step(const scenes::Simulation& simulation) override { write(simulation); }
  void commit() { file_.commit(); }

 private:
  void write(const scenes::Simulation& simulation);

  files::OutputFile file_;
};

}  // namespace boxstream::tool
