// SPDX-License-Identifier: MIT
#pragma once

#include "kinds.hpp"

namespace boxstream::report {

/// Narrow phases on pairs of shapes with closed forms.
Results narrow_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

/// The same scene on several broad-phases, compared bit by bit with boxstream.
Results neutrality_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

/// Scenes beside the same with a tiny kick: how long they stay together.
Results predictability_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

/// Scenes with their knobs turned.
Results scene_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

}  // namespace boxstream::report
