// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "measure/stopwatch.hpp"

namespace boxstream::measure {

/// The middle of at least one value; of an even number of values the mean of the middle two.
double median(std::vector<double> values);

/// The smallest value that a share `p` (0 to 1) of all values does not exceed; of at least one value.
double quantile(std::vector<double> values, double p);

/// Milliseconds of the samples of one contestant.
struct Series {
  double median = 0;
  double min = 0;
  std::size_t samples = 0;
};

/// All zero without samples.
Series summarize(const std::vector<double>& samples);

/// Of repeated measurements. The interval contains the median in 95 of 100 series like this one (bootstrap of 2000
/// samples with a fixed seed).
struct Estimate {
  double median = 0;
  double low = 0;
  double high = 0;
  double least = 0;           ///< of all values
  double instructions = NAN;  ///< of one measurement, where they were counted
};

/// Of at least one value.
Estimate estimate(const std::vector<double>& values);

struct Interleaving {
  int repeats = 7;
  double min_sample_ms = 1;    ///< short runs are repeated within a sample until it is as long as this
  double budget_seconds = 60;  ///< no new round is started after this, once there are three
  double slow_ms = 1000;       ///< contestants whose call takes longer run three rounds only
};

/// The order of contestants: the same in each round, or another random one in each, by a fixed seed. In a fixed order
/// each is always preceded by the same contestant, which leaves it the same caches and memory: a bias that no number of
/// rounds takes away.
enum class Order { forwards, shuffled };

/// Calls `visit(round, contestant)` for each of `contestants` in each round, and `on_round(round)` before: a
/// disturbance of the machine that lasts a while affects all of them.
void interleave(std::size_t contestants, const Interleaving& rules, Order order,
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
  std::vector<int> turns_of{};  ///< each
  int fewest_turns = 0;
};

/// A turn of a candidate takes at least this long, as far as `most_calls_in_turn` allow: the first call finds caches
/// and memory as the candidate before has left them, and its turn's median does not.
inline constexpr double turn_ms = 10;
inline constexpr int most_calls_in_turn = 25;

/// How often candidates get a turn.
struct Turns {
  int most = 9;
  /// Asked before each turn; once it is true no more are given, so that candidates may have had none.
  std::function<bool()> is_over = [] { return false; };
  /// Turns are no longer given to a candidate whose interval is apart from those of all others, or narrower than this
  /// share of its median, after `fewest` turns. 0: each gets `most`.
  double narrow_enough = 0.02;
  int fewest = 5;
};

/// The same for rules that end when it is settled what costs more.
Costs interleave_with_control(
    std::size_t candidates, const Turns& turns, const std::function<double(std::size_t)>& timed,
    const std::function<void(std::size_t)>& on_turn = [](std::size_t) {});

/// Calls `timed(i)`, which returns what it took, in `repeats` turns of each of `candidates` (at least one), in shuffled
/// order; and as often again of the first, as an A/A control. A turn's cost is the median of its calls. Where
/// instructions are counted, which is the same each time, a turn is one call. Does not warm up. `on_turn(i)` is called
/// before each turn.
Costs interleave_with_control(
    std::size_t candidates, int repeats, const std::function<double(std::size_t)>& timed,
    const std::function<void(std::size_t)>& on_turn = [](std::size_t) {});

}  // namespace boxstream::measure
