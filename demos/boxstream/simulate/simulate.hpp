// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boxstream/shared/print.hpp"
#include "formats/scene_model/scene.hpp"
#include "simulation/run/simulation.hpp"
#include "simulation/run/vitals.hpp"

namespace boxstream::tool {

/// Looks on while a world runs, and must change nothing in it. None of its time is counted.
class Monitor {
 public:
  virtual ~Monitor() = default;

  /// Before the first of `steps` steps.
  virtual void begin(const scenes::Simulation& simulation, std::uint64_t steps) = 0;
  /// Within a step, each time right after calculateOverlappingPairs: the one moment when pairs and boxes agree.
  virtual void after_pairs(const scenes::Simulation& simulation) = 0;
  virtual void after_step(const scenes::Simulation& simulation) = 0;
};

/// One world and what its steps reported.
struct WorldRun {
  std::string broadphase;
  std::unique_ptr<scenes::Simulation> simulation;
  std::vector<scenes::StepResult> steps;
  scenes::Vitals vitals{};
};

struct RunResult {
  /// The world asked for and, in a comparison, the same scene on the other broad-phase.
  std::vector<WorldRun> worlds;
  /// Set in a comparison: were all pair sets equal, in every step?
  std::optional<bool> pairs_equal;
  /// One line about the first pair that differed.
  std::string first_difference;

  bool is_comparison() const { return worlds.size() == 2; }
};

/// Steps the scene on one broad-phase, or on two side by side: one step each, the first of them in turn, so that
/// whatever else the machine does hits both.
///
/// A comparison also checks pairs. Two runs drift apart, since the order of pairs decides the order of contacts in the
/// solver; so each world feeds its boxes, step for step, to a second instance of the other broad-phase. The pairs of
/// the two (those whose boxes overlap: some broad-phases also hold near misses), and those of an independent search,
/// must be the same sets. This happens outside the times.
///
/// `wrap` goes around the broad-phase of the first world only; `monitors` are those of each world, of the first ones
/// where they are fewer.
RunResult run(const scenes::Scene& scene, const std::string& broadphase, const std::optional<std::string>& compare,
              std::uint64_t steps, StatusLine& status, const scenes::Simulation::Wrap& wrap = {},
              effects::Extent extent = effects::Extent::only_called,
              const std::vector<std::vector<Monitor*>>& monitors = {});

}  // namespace boxstream::tool
