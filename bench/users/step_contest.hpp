// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "suites/suites.hpp"

namespace boxstream::bench {

/// What a step's time went into. `sum` and `whole` are what is compared; the others add up to `whole`.
enum Part : std::size_t { update, pairs, dispatch, solve, rest, sum, whole, rays, parts };

using PartTimes = std::array<double, parts>;

/// A world on one broad-phase, with what its last step took. Worlds alike on different broad-phases drift apart,
/// because the order of pairs decides the order of constraints: so each is held against an oracle of its own.
class SteppedWorld {
 public:
  virtual ~SteppedWorld() = default;

  /// With `check`, holds the pairs against the oracle, outside of the times.
  virtual void step(bool check) = 0;

  /// Milliseconds of processor time.
  const PartTimes& times() const { return times_; }
  std::uint64_t pairs() const { return pairs_; }
  /// What was wrong first; empty if nothing.
  const std::string& difference() const { return difference_; }

  virtual std::size_t objects() const = 0;
  virtual bool casts_rays() const = 0;
  virtual std::string broadphase() const = 0;

 protected:
  PartTimes times_{};
  std::uint64_t pairs_ = 0;
  std::string difference_;
};

/// A stretch of steps that is reported as a case of its own.
struct Window {
  std::string suffix;  ///< of the case's name
  int begin, end;
};

/// What is reported of a case beside the `sum`.
struct StepRows {
  std::string suite, case_name;
  std::vector<Window> windows;
};

/// Steps the worlds in turn, the first one being ours, and reports how the others compare.
void contest_steps(const StepRows& rows, std::vector<std::unique_ptr<SteppedWorld>> worlds, Report& report,
                   Progress& progress);

}  // namespace boxstream::bench
