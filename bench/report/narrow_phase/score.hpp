// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "narrow_phase/engine.hpp"
#include "narrow_phase/in_child.hpp"

namespace boxstream::report::narrow {

/// What answers are worth. Errors are fractions of the size of the smaller shape, of what was answered.
struct Score {
  double error_max = 0, error_p95 = 0;  ///< NaN for verdicts, and if nothing was answered
  double missed = 0;                    ///< share of all: apart where the truth is touching
  double extra = 0;                     ///< share of all: touching where the truth is apart
  double unanswered = 0;                ///< share: not sure, exceptions, aborts, crashes, no end
  std::string failure;                  ///< "aborts on 57 of 60"; empty if all were answered
};

/// Answers about poses whose truth is within rounding of zero (1e-15 of the size) are neither missed nor extra.
Score score(Query query, std::span<const Pose> poses, std::span<const Answer> answers);

}  // namespace boxstream::report::narrow
