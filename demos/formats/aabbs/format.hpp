// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/aabb.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

/// Broadmark's `.aabbs` files: the boxes of the same objects, frame after frame. All numbers are little-endian.
///
///   char[128]  name of the scene, zeros behind it
///   char[128]  kind of objects, zeros behind it
///   int32      objects, at least 1
///   int32      steps, at least 1: the file holds the boxes at the start and those after each step
///   int32[2]   0
///   box        the world
///   box[]      `objects` boxes for each frame
///
/// A box is eight floats: min x, y, z, 0, max x, y, z, 0. Boxes are closed.
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

inline constexpr std::size_t text_size = 128;
inline constexpr std::size_t header_size = 2 * text_size + 4 * 4 + 32;
inline constexpr std::size_t box_size = 32;
inline constexpr std::uint32_t most = 0x7fffffff;

struct Header {
  std::string scene;  // at most 127 bytes, as is `type`
  std::string type;
  std::uint32_t objects = 0;
  std::uint32_t steps = 0;
  Aabb world{};
};

/// Bytes that are no such file. `what()` is one line.
class AabbsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace boxstream::aabbs
