// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstdint>

#include "formats/record/record_error.hpp"

namespace boxstream::record {

/// Few bytes can ask for many pairs: n boxes at one place have n (n - 1) / 2, which take a broad-phase of Bullet and
/// what it is compared with some 170 bytes each.
inline constexpr std::uint64_t usual_most_pairs = 1'000'000;

/// Throws RecordError if there are more.
inline void check_pairs(std::uint64_t pairs, std::uint64_t most) {
  if (pairs > most) throw RecordError(fmt::format("more than {} pairs at once (--max-pairs allows more)", most));
}

}  // namespace boxstream::record
