// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::scenes_test {

/// A shipped scene that has steps with more energy than before, and no work that explains it.
struct GainingScene {
  std::string name;
  double least, most;  ///< the largest share of the energy in the world that a step gains
  const char* reason;
};

/// All of them. Nothing else that is shipped may gain a hundredth in a step.
inline const std::vector<GainingScene> gaining_scenes{
    {"hard/ball_and_chain", 0.01, 0.03,
     "the joints stretch under a load that their rows do not bear, and pull it back with velocities"},
    {"hard/overlap_recovery", 0.5, 1.2,
     "bodies that are deep in each other are pushed apart with velocities: split_impulse is false"},
    {"hard/weight_removed", 0.04, 0.2,
     "a heavy ball that comes deep into light ones is pushed out with velocities: split_impulse is false"},
};

}  // namespace boxstream::scenes_test
