// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace boxstream::detail {

/// Most of the finaliser of SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014),
/// enough for samples.
inline std::uint64_t hash_of(std::uint64_t x) {
  x = (x + 0x9e3779b97f4a7c15) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

}  // namespace boxstream::detail
