// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "statistics.hpp"

namespace boxstream::accuracy {

/// What candidates cost that were timed by turns.
struct Turns {
  std::vector<Estimate> costs;
  /// By how much two series of the first candidate, timed like all others, differ: |a / b - 1| of their medians. What
  /// is closer than that is not told apart.
  double twin_spread = 0;
};

/// Calls `timed(i)`, which returns what it took, `repeats` times for each of `candidates` (at least one), forwards and
/// backwards in turn, so that whatever disturbs the machine for a while meets all of them; and as often again for the
/// twin of the first. Does not warm up.
Turns take_turns(std::size_t candidates, int repeats, const std::function<double(std::size_t)>& timed);

}  // namespace boxstream::accuracy
