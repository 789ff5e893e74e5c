// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/ccd.hpp>
#include <string>

#include "hard_pose.hpp"

namespace boxstream::poses {

/// What boxstream::ccd makes of a pose, held against the truth.
struct Verdict {
  enum class Kind {
    right,   ///< every answer is `ok` and within the documented tolerance
    honest,  ///< some answer says that it is not `ok`, and its bounds hold
    wrong,
    no_such_shape
  } kind = Kind::right;
  double value = 0;  ///< signed distance, or minus the depth
  double truth = 0;
  std::string why{};  ///< what is wrong, or how honest
};

const char* name(Verdict::Kind kind);

/// intersect, penetration and distance, of each pair of convex parts.
Verdict ask_ccd(const Solid& a, const Solid& b, const ccd::Options& options = {});

}  // namespace boxstream::poses
