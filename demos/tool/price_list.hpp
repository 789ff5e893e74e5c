// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "status_line.hpp"

namespace boxstream::tool {

/// What one effect costs, measured against the same scene without it.
struct Price {
  std::string effect;
  std::string scene;              ///< that calls for it, of demos/scenes/effects
  std::uint64_t bodies = 0;       ///< of that scene, as often as it was repeated
  double ns = 0;                  ///< a body and step more, where the scene calls for it
  double ns_uncalled = 0;         ///< where no scene calls for it, and it is built all the same
  double noise = 0;               ///< of both: half the width of the middle half of the differences
  double bytes = 0;               ///< a body more, when the run is over
  double pairs = 0;               ///< a body more, on average
};

struct PriceOptionsOfRun {
  int copies;  ///< of each gallery scene, side by side
  int steps;   ///< that are timed at once
  int rounds;  ///< of with, without, without, with
};

std::vector<Price> measure_prices(const PriceOptionsOfRun& options, StatusLine& status);

}  // namespace boxstream::tool
