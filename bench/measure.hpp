// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <vector>

namespace boxstream::bench {

/// Milliseconds of the samples of one contestant.
struct Series {
  double median = 0;
  double min = 0;
};

Series summarize(std::vector<double> samples);

/// Milliseconds of processor time that one call takes on the calling thread. For work on one thread this is what a
/// clock on the wall shows on an idle machine; on a busy one the wall clock punishes whatever runs longer than a time
/// slice, and so distorts ratios.
double time_once(const std::function<void()>& run);

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
};

/// One Series per contestant, from rounds in which each runs once in turn: whatever disturbs the machine for a while
/// meets all of them. Call each once beforehand if it needs warming up.
std::vector<Series> measure_interleaved(const std::vector<std::function<void()>>& contestants,
                                        const Interleaving& interleaving, const std::function<void(int)>& on_round);

}  // namespace boxstream::bench
