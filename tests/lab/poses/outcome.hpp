// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hard_pose.hpp"

namespace boxstream::poses {

enum class Manager { boxstream, native };
enum class Solver { libccd, indep };

/// What came of giving a pose to a manager whose callback asks FCL's narrow phase, in a process of its own: FCL may
/// abort or not end.
struct Outcome {
  int delivered = 0;     ///< calls with this pair
  bool in_order = true;  ///< A first in all of them
  /// "right", "wrong", "throws", "aborts", "crashes", "no end", or "silent" if the process ended without an answer.
  std::string kind;
  double value = 0;     ///< as in Known
  std::string message;  ///< what was thrown, what is wrong
  int after = 0;        ///< calls with this pair in another query of the manager, after the answer or the exception
};

/// Runs `program`, the one of probe.cpp.
Outcome run(const std::string& program, const HardPose& pose, Manager manager, Solver solver);

/// The same for all poses of gaps.hpp, some in one process, with our manager.
std::vector<Outcome> run_gaps(const std::string& program, Solver solver);

const char* name(Manager manager);
const char* name(Solver solver);

}  // namespace boxstream::poses
