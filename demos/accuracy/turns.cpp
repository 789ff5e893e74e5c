// SPDX-License-Identifier: MIT
#include "turns.hpp"

#include <cmath>

#include "stopwatch.hpp"

namespace boxstream::accuracy {

Turns take_turns(std::size_t candidates, int repeats, const std::function<double(std::size_t)>& timed) {
  // The twin of the first comes last.
  std::vector<std::vector<double>> times(candidates + 1);
  std::vector<double> instructions(candidates + 1, NAN);
  for (int round = 0; round < repeats; ++round)
    for (std::size_t turn = 0; turn < times.size(); ++turn) {
      const std::size_t which = round % 2 == 0 ? turn : times.size() - 1 - turn;
      const double before = counted_instructions();
      times[which].push_back(timed(which % candidates));
      instructions[which] = counted_instructions() - before;
    }
  Turns turns;
  for (std::size_t i = 0; i < candidates; ++i) {
    turns.costs.push_back(estimate(times[i]));
    turns.costs.back().instructions = instructions[i];
  }
  turns.twin_spread = std::abs(turns.costs.front().median / quantile(times.back(), 0.5) - 1);
  return turns;
}

}  // namespace boxstream::accuracy
