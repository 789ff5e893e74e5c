// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

#include "base/keys.hpp"

namespace boxstream::detail {

/// A box on its way through the tree: its bounds as keys, the caller's index, and for each axis (bit d) whether
/// the box begins before the region of the node that this copy is in.
///
/// A pair belongs to the one region that holds the low corner of the intersection. On an axis that corner is the larger
/// of the two low ends (property 2 in section 2 of Zomorodian and Edelsbrunner, Fast software for box intersections,
/// 2002), so a region owns a pair unless both boxes began before it: (a.before & b.before) == 0.
/// One bit more is that of boxes that do not meet each other, whatever they overlap.
struct Record {
  static constexpr int standing_bit = 3;

  std::int32_t lo[3];
  std::uint32_t id;
  std::int32_t hi[3];
  std::uint32_t before;
};
static_assert(sizeof(Record) == 32);

}  // namespace boxstream::detail
