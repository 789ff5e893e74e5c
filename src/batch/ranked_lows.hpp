// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>

namespace boxstream::detail {

/// A key and a position in one number: sorting the numbers sorts by key, equal keys by position.
inline std::uint64_t ranked(std::int32_t key, std::size_t position) {
  assert(position <= UINT32_MAX);
  return std::uint64_t{static_cast<std::uint32_t>(key) ^ 0x80000000u} << 32 | position;
}

inline std::int32_t key_of(std::uint64_t ranked) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(ranked >> 32) ^ 0x80000000u);
}

inline std::uint32_t position_of(std::uint64_t ranked) {
  return static_cast<std::uint32_t>(ranked);
}

/// How many of n sorted entries have a key below `key`, or at it as well if `inclusive`. Without branches, for the
/// outcome of its comparisons is unpredictable.
inline std::size_t count_below(const std::uint64_t* sorted, std::size_t n, std::int32_t key, bool inclusive) {
  const std::uint64_t bound = ranked(key, 0) + (inclusive ? std::uint64_t{1} << 32 : 0);  // keys stay below 2^31 - 1
  std::size_t first = 0;
  while (n > 0) {
    const std::size_t half = n / 2;
    first = sorted[first + half] < bound ? first + n - half : first;
    n = half;
  }
  return first;
}

}  // namespace boxstream::detail
