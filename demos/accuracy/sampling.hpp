// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "candidates.hpp"
#include "measure/clock.hpp"

/// The runs of a sweep: what they say of each setting, and what they cost.
namespace boxstream::accuracy {

/// Runs are counted and timed for those who wait.
class Runs {
 public:
  Runs(const Request& request, const Progress& progress) : request_(request), progress_(progress) {}

  void next(const std::string& what, double seconds_left = NAN) {
    const double most = std::max(0.0, request_.budget - seconds());
    const bool is_bounded = std::isnan(seconds_left) && std::isfinite(most);
    progress_({done_++, all, seconds_left,
               is_bounded ? what + ", at most " + std::to_string(std::lround(most)) + " s left" : what});
  }
  bool is_over() const { return is_stopped() || elapsed_.seconds() > request_.budget; }
  bool is_stopped() const { return request_.stop && request_.stop(); }
  double seconds() const { return elapsed_.seconds(); }

  std::size_t all = 0;

 private:
  const Request& request_;
  const Progress& progress_;
  std::size_t done_ = 0;
  measure::Elapsed elapsed_;
};

/// How many steps of the scene the budget allows, of `steps`; `runs` is what all runs cost beside one of the scene. By
/// running it: later steps may take several times as long as the first ones.
std::uint64_t affordable(const Request& request, const scenes::Scene& plain, std::uint64_t steps, double runs);

/// Runs and samples candidates, says which are sound, and measures what they cost as long as that is not settled. Those
/// that were not run are gone: when the request said stop, or what was sought is found.
void sample_and_time(const Request& request, std::vector<Candidate>& candidates, Sweep& sweep, Runs& runs);

}  // namespace boxstream::accuracy
