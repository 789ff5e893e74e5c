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

/// Kinds of boxes in the broad-phase of a Bullet world, and what they do to its steps.
Results box_kinds_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

/// The same batch on all threads and SIMD targets.
Results cells_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

/// Boxes far from the origin, in floats, doubles and integers.
Results far_boxes_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

/// Rods that FCL asks for, in loose and tight boxes.
Results fcl_boxes_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

/// FCL's narrow phase behind each manager.
Results fcl_managers_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

/// Boxes from frame to frame, and ways from them to pairs.
Results frames_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

/// Forms of an answer: counted, streamed, listed, sorted, as changes.
Results outputs_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

/// Scenes with their knobs turned.
Results scene_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress);

}  // namespace boxstream::report
