// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "boxstream/shared/print.hpp"
#include "simulation/effects/effect.hpp"

namespace boxstream::tool {

/// What one world costs more than another one, for each body that is not fixed. Measured are either the instructions
/// (measure/stopwatch.hpp) or all else.
struct Difference {
  double ns = 0;             ///< a step: the median over rounds of the median over steps, of two interleaved worlds
  double low = 0, high = 0;  ///< the least and the greatest of the rounds
  double bytes = 0;          ///< of memory, when the run is over
  double pairs = 0;          ///< in the pair cache, on average
  double instructions = 0;   ///< a step: the mean over steps
};

/// The price of one effect.
struct Price {
  const char* effect;
  std::string with, without;         ///< scenes of demos/scenes/effects; one and the same: the effect is left out of it
  std::uint64_t bodies = 0;          ///< that are not fixed
  std::optional<Difference> called;  ///< none: nothing runs for it
  std::optional<Difference> uncalled;  ///< built for a scene that does not call for it; none: nothing is built
};

struct PriceEffort {
  int copies;  ///< of each scene, side by side in one world
  int steps;
  int rounds;  ///< each with new worlds; instructions are counted in one
};

/// Measures all effects, on the scenes that come with the tool. Throws BadInput if these are not there.
std::vector<Price> measure_prices(const PriceEffort& effort, StatusLine& status);

/// As it is recorded: nanoseconds a body and step, and the least and the greatest of what was measured.
struct MeasuredPrice {
  double ns, low, high;
};

/// What a table says of it.
std::string cost_text(const MeasuredPrice& price, const effects::Effect& effect);

}  // namespace boxstream::tool
