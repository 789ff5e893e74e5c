// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace boxstream::detail {

/// Words that hold a bit for each of `size`.
constexpr std::size_t bit_words(std::size_t size) {
  return (size + 63) / 64;
}

/// Calls `visit(bit)` for each bit that is set, in order.
template <class Visit>
inline void for_each_bit(std::uint64_t word, Visit&& visit) {
  for (; word != 0; word &= word - 1) visit(static_cast<unsigned>(std::countr_zero(word)));
}

/// Calls `visit(index)` for each bit that is set in some words, in order, until it returns false.
template <class Visit>
inline void for_each_index(const std::uint64_t* bits, std::size_t words, Visit&& visit) {
  for (std::size_t w = 0; w < words; ++w)
    for (std::uint64_t left = bits[w]; left != 0; left &= left - 1)
      if (!visit(static_cast<std::uint32_t>(64 * w) + static_cast<std::uint32_t>(std::countr_zero(left)))) return;
}

/// Sets `count` bits, and no other of their words.
inline void set_first(std::uint64_t* bits, std::size_t count) {
  for (; count >= 64; count -= 64) *bits++ = ~std::uint64_t{0};
  if (count > 0) *bits = ~(~std::uint64_t{0} << count);
}

}  // namespace boxstream::detail
