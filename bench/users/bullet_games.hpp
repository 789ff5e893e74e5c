// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "users/bullet_game.hpp"

namespace boxstream::bench {

/// A world that users of Bullet have.
struct GameCase {
  std::string name, description;
  void (*build)(Game& game, int n);
  std::vector<int> sizes;        ///< n: see `description`
  std::vector<int> quick_sizes;  ///< of these
  int settle = 0;                ///< steps on btDbvtBroadphase before the worlds begin, all in the state they lead to
  int steps = 120;
  bool borrows_cache = false;
  bool only_detects = false;  ///< nothing moves: timed are many calls of updateAabbs and calculateOverlappingPairs
};

const std::vector<GameCase>& game_cases();

}  // namespace boxstream::bench
