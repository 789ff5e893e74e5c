// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>
#include <boxstream/world.hpp>

namespace boxstream::report {

/// Boxes searched with room around them, so that pairs hold good until one leaves its room: then that one gets a new
/// room, and is searched for again. Candidates are the pairs whose rooms touch: all that touch, and extra ones.
///
/// It does not foresee motion: the room is the same on both sides.
class FatBoxes {
 public:
  /// The room on each side, as a share of the mean side of the box: 0.05 for 5 %.
  explicit FatBoxes(double share) : share_(share) {}

  /// Forgets what was before.
  void start(Span<const Aabb> boxes);

  /// The next frame of the same boxes; `moved` lists those that were set again. Returns how many left their room.
  std::size_t next_frame(Span<const Aabb> boxes, Span<const std::uint32_t> moved);

  /// Pairs whose rooms touch, in order.
  const std::vector<Pair>& candidates() const { return candidates_; }

 private:
  Aabb room_of(const Aabb& box) const;
  void list();

  double share_;
  World world_;
  std::vector<ProxyId> ids_;
  std::vector<Aabb> rooms_;
  std::vector<Pair> candidates_;
  std::vector<ProxyId> left_ids_;
  std::vector<Aabb> left_rooms_;
};

}  // namespace boxstream::report
