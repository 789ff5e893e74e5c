// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

#include "boxstream/shared/command.hpp"
#include "formats/record/pair_limit.hpp"

namespace boxstream::tool {

/// Bullet counts pairs in `int`.
inline Option add_max_pairs(CommandLine& command, std::uint64_t& most) {
  return add_number(command, "--max-pairs", most, "Refuse more pairs at once than this; default: 1000000", 1,
                    std::numeric_limits<int>::max());
}

}  // namespace boxstream::tool
