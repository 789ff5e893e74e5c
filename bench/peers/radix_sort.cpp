// SPDX-License-Identifier: MIT
#include "peers/radix_sort.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

namespace boxstream::bench {

namespace {

constexpr int passes = 4, digit_bits = 8;
constexpr std::size_t digits = std::size_t{1} << digit_bits;

/// Unsigned integers in the order of the floats.
std::uint32_t key_of(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits ^ ((bits >> 31) ? 0xffffffffu : 0x80000000u);
}

}  // namespace

Span<const std::uint64_t> RadixSort::sort(Span<const Aabb> boxes) {
  const std::size_t n = boxes.size();
  elements_.resize(n);
  scratch_.resize(n);
  std::array<std::array<std::uint32_t, digits>, passes> counts{};
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t key = key_of(boxes[i].min[0]);
    elements_[i] = std::uint64_t{key} << 32 | i;
    for (int pass = 0; pass < passes; ++pass)
      ++counts[static_cast<std::size_t>(pass)][(key >> (pass * digit_bits)) % digits];
  }
  for (int pass = 0; pass < passes; ++pass) {
    std::array<std::uint32_t, digits>& places = counts[static_cast<std::size_t>(pass)];
    std::uint32_t sum = 0;
    for (std::uint32_t& place : places) sum += std::exchange(place, sum);
    for (const std::uint64_t element : elements_)
      scratch_[places[(element >> (32 + pass * digit_bits)) % digits]++] = element;
    elements_.swap(scratch_);
  }
  return elements_;
}

}  // namespace boxstream::bench
