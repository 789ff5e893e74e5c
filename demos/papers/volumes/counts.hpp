// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace boxstream::papers::volumes {

/// What a search spends: T = volume_tests C_v + primitive_tests C_p + updates C_u, with the costs of one each.
struct Counts {
  std::uint64_t volume_tests = 0;     ///< volumes compared: nodes visited
  std::uint64_t primitive_tests = 0;  ///< objects compared
  std::uint64_t updates = 0;          ///< volumes made anew because objects moved
};

}  // namespace boxstream::papers::volumes
