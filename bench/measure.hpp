// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace boxstream::bench {

/// Milliseconds of the samples of one contestant.
struct Series {
  double median = 0;
  double min = 0;
  std::size_t samples = 0;
};

Series summarize(std::vector<double> samples);

/// `cpu`: processor time of the calling thread. For work on one thread this is what a clock on the wall shows on an
/// idle machine; on a busy one the wall clock punishes whatever runs longer than a time slice, and so distorts ratios.
/// `wall`: elapsed time, for work on several threads.
enum class Clock { cpu, wall };

/// "cpu" or "wall".
std::string clock_name(Clock clock);

/// Milliseconds that one call takes.
double time_once(const std::function<void()>& run, Clock clock = Clock::cpu);

/// Tells whether the calling thread had the processor to itself since this object was made.
class InterruptionWatch {
 public:
  InterruptionWatch();
  /// True if more than a fiftieth of the time, and more than 0.1 ms, went by without the thread running.
  bool interrupted() const;

 private:
  std::chrono::steady_clock::time_point wall_;
  double thread_ms_;
};

struct Interleaving {
  int repeats = 7;
  double min_sample_ms = 1;    ///< quick runs are called several times a sample, so that the clock's grain is nothing
  double budget_seconds = 60;  ///< no new round is started after this, once there are three
  double slow_ms = 1000;       ///< who takes longer than this for one call takes part in three rounds only
};

/// Who takes part in rounds: `run` is timed, and called between `prepare` and `release`, which are not timed.
struct Contestant {
  std::function<void()> run;
  std::function<void()> prepare = [] {};
  std::function<void()> release = [] {};
  Clock clock = Clock::cpu;
  double expected_ms = 0;  ///< what one call took before; 0: not known, so one is made to see
};

/// One Series per contestant, from rounds in which each runs once in turn: whatever disturbs the machine for a while
/// meets all of them. Call each once beforehand if it needs warming up.
std::vector<Series> measure_interleaved(const std::vector<Contestant>& contestants, const Interleaving& interleaving,
                                        const std::function<void(int)>& on_round);

}  // namespace boxstream::bench
