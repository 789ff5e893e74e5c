// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/record/op.hpp"

namespace boxstream::record {

// What writer and reader have in common. docs/bsrec.md describes the bytes; its tables and these go together.

/// Text modes and old mail gateways change one of the last three.
inline constexpr std::array<std::uint8_t, 8> magic{'B', 'S', 'R', 'E', 'C', '\r', '\n', 0x1a};
inline constexpr std::uint8_t version = 1;

enum class Code : std::uint8_t {
  end = 0x00,
  create = 0x01,
  destroy = 0x02,
  refilter = 0x03,
  box_query = 0x04,
  ray_query = 0x05,
  thick_ray_query = 0x06,  // with extents
  batch = 0x07,
  reset_pool = 0x08,
  move = 0x40,  // to 0x7f: the low six bits say which coordinates are new, in the order of Coordinates
};
inline constexpr std::uint8_t move_mask = 0x3f;

/// Minimum x, y, z, then maximum x, y, z.
using Coordinates = std::array<double, 6>;

inline Coordinates coordinates_of(const Aabb64& box) {
  return {box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]};
}
inline Aabb64 box_of(const Coordinates& c) {
  return {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}};
}

/// The proxies as both ends of a stream have them: moves are written as changes of the last box, and proxies are named
/// by their distance from the last one named.
struct Proxies {
  struct Proxy {
    bool alive;
    Coordinates box;
  };
  std::vector<Proxy> by_id;
  std::uint32_t last_named = 0;

  bool is_alive(std::uint64_t id) const { return id < by_id.size() && by_id[id].alive; }
};

}  // namespace boxstream::record
