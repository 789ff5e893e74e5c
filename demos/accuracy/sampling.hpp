// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "candidates.hpp"
#include "measure/stopwatch.hpp"
#include "reference.hpp"
#include "sweep.hpp"

namespace boxstream::accuracy {

/// The failure of a reference that the budget has no time for.
inline constexpr const char* takes_too_long = "it would take longer than the budget allows";

/// Runs the sequence that settings are compared with: the scene as it is, with steps finer than those of all settings,
/// iterations that do not limit it, and the solvers that are exact where the scene is small enough for them. `finest`:
/// substeps of a step of the scene that the finest setting comes to. `needed`: whatever the budget says. A sequence
/// that gains energy, breaks a check or loses a body is no reference, and `failure` says so. It is of double precision
/// where there is a source, which is what the scene is made of.
Reference run_reference(const Request& request, scenes::Scene scene, const std::optional<Source>& source,
                        std::uint64_t steps, double finest, bool needed,
                        const std::function<void(const std::string&)>& on_run);

/// Runs a scene for `row.steps` steps, samples it after each, and fills in the series, values, vitals, cost and failure
/// of `row`. If `trajectory` is given, it is filled in too. False if the request said stop before the end: then `row`
/// says nothing.
bool run_and_sample(const Request& request, const scenes::Scene& scene, const Reference& reference, Row& row,
                    Trajectory* trajectory = nullptr);

// The runs of a sweep: what they say of each setting, and what they cost.

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
