// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine.hpp"
#include "in_child.hpp"

namespace boxstream::report::narrow {

/// What answers are worth. Errors are fractions of the size of the smaller shape, of what was answered.
struct Score {
  double error_max = 0, error_p95 = 0;  ///< NaN for verdicts, and if nothing was answered
  double wrong = 0;                     ///< share: touching where the truth is apart, or the other way round
  double unanswered = 0;                ///< share: exceptions, aborts, crashes, no end
  std::string failure;                  ///< "aborts on 57 of 60"; empty if all were answered
};

/// An answer is wrong if it has the wrong sign and the truth is not within rounding of zero (1e-15 of the size).
Score score(Query query, std::span<const Pose> poses, std::span<const Answer> answers);

}  // namespace boxstream::report::narrow
