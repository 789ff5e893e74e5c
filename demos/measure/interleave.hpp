// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "measure/statistics.hpp"
#include "measure/stopwatch.hpp"

namespace boxstream::measure {

struct Interleaving {
  int repeats = 7;
  double min_sample_ms = 1;    ///< short runs are repeated within a sample until it is as long as this
  double budget_seconds = 60;  ///< no new round is started after this, once there are three
  double slow_ms = 1000;       ///< contestants whose call takes longer run three rounds only
};

/// The order of contestants: the same in each round, or reversed in every other one.
enum class Direction { forwards, back_and_forth };

/// Calls `visit(round, contestant)` for each of `contestants` in each round, and `on_round(round)` before: a
/// disturbance of the machine that lasts a while affects all of them.
void interleave(std::size_t contestants, const Interleaving& rules, Direction direction,
                const std::function<void(int)>& on_round, const std::function<void(int, std::size_t)>& visit);

/// `run` is timed, and called between `prepare` and `release`, which are not timed.
struct Contestant {
  std::function<void()> run;
  std::function<void()> prepare = [] {};
  std::function<void()> release = [] {};
  Clock clock = Clock::cpu;
  double expected_ms = 0;  ///< what one call took before; 0: not known, so one is made first
};

/// One Series per contestant, interleaved forwards. Warm them up beforehand if they need it.
std::vector<Series> measure_interleaved(const std::vector<Contestant>& contestants, const Interleaving& rules,
                                        const std::function<void(int)>& on_round);

/// Costs of candidates, with an A/A control.
struct Costs {
  std::vector<Estimate> of;
  /// By how much two series of the first candidate, timed like all others, differ: |a / b - 1| of their medians.
  /// Smaller differences between candidates are not significant.
  double control_spread = 0;
};

/// Calls `timed(i)`, which returns what it took, `repeats` times for each of `candidates` (at least one), interleaved
/// back and forth; and as often again for the first, as an A/A control. Does not warm up.
Costs interleave_with_control(std::size_t candidates, int repeats, const std::function<double(std::size_t)>& timed);

}  // namespace boxstream::measure
