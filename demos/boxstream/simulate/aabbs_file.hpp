// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/output_file.hpp"
#include "boxstream/simulate/monitor.hpp"
#include "formats/aabbs/writer.hpp"

namespace boxstream::tool {

/// The boxes of all objects of a world, as its broad-phase has them, as an `.aabbs` file: those at the start, and in
/// each step those that its pairs belong to. Objects that are out of the world have an inverted box.
class AabbsFile : public Monitor {
 public:
  /// Throws as files::OutputFile does.
  explicit AabbsFile(const std::string& path);

  /// Throws BadInput if there are no objects, which the format cannot say.
  void begin(const scenes::Simulation& simulation, std::uint64_t steps) override;
  void after_pairs(const scenes::Simulation& simulation) override;
  void after_step(const scenes::Simulation& simulation) override;

  void finish();
  void commit() { file_.commit(); }

 private:
  files::OutputFile file_;
  std::optional<aabbs::Writer> writer_;
  std::vector<Aabb> boxes_;
};

}  // namespace boxstream::tool
