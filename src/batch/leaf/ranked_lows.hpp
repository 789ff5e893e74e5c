// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

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

/// Sorts n numbers of `ranked` whose positions ascend, in one of the two arrays, and returns which. Digit by digit from
/// the lowest of the keys' bits in which they differ: a comparison would be mispredicted every other time.
inline std::uint64_t* sort_ranked(std::uint64_t* numbers, std::uint64_t* other, std::size_t n) {
  constexpr unsigned digit_bits = 8, digits = 4, values = 1u << digit_bits;
  constexpr std::size_t few = 48;  // sorted before the counters are cleared
  if (n < few) {
    std::sort(numbers, numbers + n);
    return numbers;
  }
  std::uint64_t least = ~std::uint64_t{0}, most = 0;
  for (std::size_t i = 0; i < n; ++i) {
    least = std::min(least, numbers[i]);
    most = std::max(most, numbers[i]);
  }
  least &= ~std::uint64_t{UINT32_MAX};
  const unsigned passes = (static_cast<unsigned>(std::bit_width((most - least) >> 32)) + digit_bits - 1) / digit_bits;
  std::uint32_t places[digits][values] = {};
  const auto digit = [least](std::uint64_t number, unsigned pass) {
    return (number - least) >> (32 + pass * digit_bits) & (values - 1);
  };
  for (std::size_t i = 0; i < n; ++i)
    for (unsigned pass = 0; pass < passes; ++pass) ++places[pass][digit(numbers[i], pass)];
  for (unsigned pass = 0; pass < passes; ++pass) {
    std::uint32_t sum = 0;
    for (std::uint32_t& place : places[pass]) sum += std::exchange(place, sum);
    for (std::size_t i = 0; i < n; ++i) other[places[pass][digit(numbers[i], pass)]++] = numbers[i];
    std::swap(numbers, other);
  }
  return numbers;
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
