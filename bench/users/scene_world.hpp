// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "suites/suites.hpp"
#include "users/step_contest.hpp"

namespace boxstream::bench {

/// A shipped scene as a case.
struct SceneCase {
  std::string scene;
  std::vector<Window> windows;
  int quick_steps;
};

/// Bodies are created in the first steps of a broad-phase's life, whose cost is not that of a frame.
inline constexpr int warm_up_steps = 5;

std::string scene_path(const std::string& name);

/// Whose rows they are, and the last part of a step that counts for `Part::sum`.
struct Summed {
  std::string suite;
  Part last;
};

/// Runs a scene on boxstream and the other broad-phases.
void run_scene(const Summed& summed, SceneCase scene, const Options& options, const std::vector<std::string>& peers,
               Report& report, Progress& progress);

}  // namespace boxstream::bench
