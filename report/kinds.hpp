// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiment.hpp"
#include "results.hpp"

namespace boxstream::report {

struct RunOptions {
  int repeats = 9;  ///< timed runs of each candidate, taking turns
};

/// Called before each piece of work with what it is.
using Progress = std::function<void(const std::string& what)>;

/// Measures an experiment. Throws BadExperiment for settings that it does not understand; a candidate that fails is a
/// point with a failure.
using Kind = Results (*)(const Experiment&, const RunOptions&, const Progress&);

struct NamedKind {
  std::string name;
  Kind run;
};

/// Those that were built in.
const std::vector<NamedKind>& kinds();

}  // namespace boxstream::report
