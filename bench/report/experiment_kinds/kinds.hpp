// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "format/experiment.hpp"
#include "format/results.hpp"
#include "measure/interleave.hpp"

namespace boxstream::report {

/// Called before each piece of work with its name.
using Progress = std::function<void(const std::string& what)>;

/// An experiment while it is measured. All is borrowed.
struct Measurement {
  const Experiment& experiment;
  int repeats;  ///< timed runs of each candidate, interleaved
  const Progress& progress;
  Results& results;

  const nlohmann::json& settings() const { return experiment.settings; }

  /// Times candidates, interleaved with an A/A control, and adds a point for each: what `point_of(candidate, cost)`
  /// returns, with the panel and the cost filled in. `timed(candidate)` returns what one run cost.
  template <class Candidates, class Timed, class PointOf>
  void add_points(const std::string& panel, Candidates& candidates, Timed timed, PointOf point_of) {
    const measure::Costs costs = measure::interleave_with_control(candidates.size(), repeats,
                                                                  [&](std::size_t i) { return timed(candidates[i]); });
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      results.points.push_back(point_of(candidates[i], costs.of[i]));
      results.points.back().panel = panel;
      results.points.back().cost = costs.of[i];
    }
    results.controls.push_back({panel, costs.control_spread});
  }
};

/// Throws BadExperiment, nlohmann::json::exception, std::invalid_argument, accuracy::BadKnob or scenes::SceneError for
/// settings that it cannot use. A candidate that fails is a point with a failure.
using Measure = void(Measurement&);

struct ExperimentKind {
  std::string name;
  std::string cost_unit;
  std::vector<std::string> metrics;
  Measure* measure;
  bool has_threads = false;  ///< else it is measured on one processor
};

/// All that were built in.
const std::vector<ExperimentKind>& experiment_kinds();

/// Throws BadExperiment for an experiment of an unknown kind.
const ExperimentKind& kind_of(const Experiment& experiment);

/// Measures an experiment. Throws BadExperiment, which begins with the file, for all errors in settings.
Results run_experiment(const Experiment& experiment, int repeats, const Progress& progress);

}  // namespace boxstream::report
