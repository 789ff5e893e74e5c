// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <boxstream/aabb.hpp>
#include <cstdint>

namespace boxstream::aabbs {

using Bytes = const unsigned char*;

inline std::uint32_t word(Bytes at) {
  return std::uint32_t{at[0]} | std::uint32_t{at[1]} << 8 | std::uint32_t{at[2]} << 16 | std::uint32_t{at[3]} << 24;
}

inline Aabb box(Bytes at) {
  Aabb box{};
  for (int d = 0; d < 3; ++d) {
    box.min[d] = std::bit_cast<float>(word(at + 4 * d));
    box.max[d] = std::bit_cast<float>(word(at + 16 + 4 * d));
  }
  return box;
}

}  // namespace boxstream::aabbs
