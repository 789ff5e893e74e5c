// SPDX-License-Identifier: MIT
#pragma once

#include "kinds.hpp"

namespace boxstream::report {

/// Scenes with their knobs turned.
Results scene_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

}  // namespace boxstream::report
