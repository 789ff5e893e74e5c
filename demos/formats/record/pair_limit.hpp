// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>

namespace boxstream::record {

/// Bytes that are no stream, or a stream that cannot be replayed here. `what()` is one line: "offset N: reason" where
/// it is about a place.
class RecordError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Few bytes can ask for many pairs: n boxes at one place have n (n - 1) / 2, which take a broad-phase of Bullet and
/// what it is compared with some 170 bytes each.
inline constexpr std::uint64_t usual_most_pairs = 1'000'000;

/// Throws RecordError if there are more.
inline void check_pairs(std::uint64_t pairs, std::uint64_t most) {
  if (pairs > most) throw RecordError(fmt::format("more than {} pairs at once (--max-pairs allows more)", most));
}

}  // namespace boxstream::record
