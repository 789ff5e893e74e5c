// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/output_file.hpp"
#include "boxstream/simulate/simulate.hpp"
#include "formats/aabbs/writer.hpp"
#include "formats/record/writer.hpp"
#include "formats/scene_model/checks.hpp"
#include "simulation/run/simulation.hpp"

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

/// The recording of one world's broad-phase calls, as a file.
class LogFile {
 public:
  /// Throws as files::OutputFile does.
  LogFile(const std::string& path, const scenes::Scene& scene, const std::string& broadphase);

  /// For the Simulation to be recorded, of which there is one, and which this must outlive.
  scenes::Simulation::Wrap wrap();
  /// Ends the recording: what the world does later, such as being taken down, is not in it.
  void finish();
  void commit() { file_.commit(); }

 private:
  files::OutputFile file_;
  record::Writer writer_;
};

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

/// What the scene calls an object; empty if it has no name.
std::string object_name(const scenes::Simulation& simulation, std::size_t object);

/// A row for each object that entered or left a sensor, in order of steps, of the world asked for.
std::string events_table(const scenes::Scene& scene, const RunResult& result);

}  // namespace boxstream::tool
