// SPDX-License-Identifier: MIT
#pragma once

#include "accuracy/sweep.hpp"
#include "experiment_kinds/kinds.hpp"

namespace boxstream::report {

/// Knobs of an experiment: an object of names and values (in the order of the names), or a list of objects with `name`,
/// `values` and, where they are needed, `at` (a pointer into the scene) and `labels`. A value "1/60" is a fraction.
/// Throws accuracy::BadKnob, nlohmann::json::exception.
std::vector<accuracy::Knob> knobs_of(const nlohmann::json& description);

/// What to do with one scene of an experiment. Throws like knobs_of, and BadExperiment for a file that is none.
accuracy::Request request_of(const Experiment& experiment, const std::string& scene, int repeats);

}  // namespace boxstream::report
