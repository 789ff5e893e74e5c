// SPDX-License-Identifier: MIT
#include "boxes/fat_boxes.hpp"

namespace boxstream::report {
namespace {

bool inside(const Aabb& box, const Aabb& room) {
  for (int d = 0; d < 3; ++d)
    if (!(room.min[d] <= box.min[d] && box.max[d] <= room.max[d])) return false;
  return true;
}

}  // namespace

// Merged, because a room thinner than a unit in the last place may round to less than the box.
Aabb FatBoxes::room_of(const Aabb& box) const {
  double sides = 0;
  for (int d = 0; d < 3; ++d) sides += static_cast<double>(box.max[d]) - static_cast<double>(box.min[d]);
  return merged(box, expanded(box, static_cast<float>(share_ * sides / 3)));
}

void FatBoxes::start(Span<const Aabb> boxes) {
  rooms_.clear();
  for (const Aabb& box : boxes) rooms_.push_back(room_of(box));
  world_.clear();
  ids_.resize(boxes.size());
  world_.create(rooms_, {}, ids_);
  world_.update();
  list();
}

std::size_t FatBoxes::next_frame(Span<const Aabb> boxes, Span<const std::uint32_t> moved) {
  left_ids_.clear();
  left_rooms_.clear();
  for (const std::uint32_t i : moved) {
    if (inside(boxes[i], rooms_[i])) continue;
    rooms_[i] = room_of(boxes[i]);
    left_ids_.push_back(ids_[i]);
    left_rooms_.push_back(rooms_[i]);
  }
  if (left_ids_.empty()) return 0;
  world_.move(left_ids_, left_rooms_);
  const WorldStats stats = world_.update();
  if (stats.begun != 0 || stats.ended != 0) list();
  return left_ids_.size();
}

void FatBoxes::list() {
  candidates_.clear();
  world_.stream_pairs([this](Span<const ProxyPair> held) {
    // The slots of a World that was never given anything else count up.
    for (const ProxyPair& pair : held) candidates_.push_back({pair.a.slot, pair.b.slot});
    return true;
  });
}

}  // namespace boxstream::report
