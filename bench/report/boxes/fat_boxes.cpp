// SPDX-License-Identifier: MIT
#include "boxes/fat_boxes.hpp"

#include <algorithm>
#include <iterator>

namespace boxstream::report {

// Merged, because a margin below a unit in the last place may round to less than the box.
Aabb FatBoxes::fattened(const Aabb& box) const {
  double sides = 0;
  for (int d = 0; d < 3; ++d) sides += static_cast<double>(box.max[d]) - static_cast<double>(box.min[d]);
  return merged(box, expanded(box, static_cast<float>(share_ * sides / 3)));
}

void FatBoxes::find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) {
  fat_.clear();
  for (const Aabb& box : boxes) fat_.push_back(fattened(box));
  world_.emplace();
  ids_.resize(boxes.size());
  world_->create(fat_, {}, ids_);
  world_->update();
  list_candidates();
  hand_over(boxes, pairs);
}

void FatBoxes::next_frame(Span<const Aabb> boxes, Span<const std::uint32_t> moved, std::vector<Pair>& pairs) {
  exited_.clear();
  exited_fat_.clear();
  for (const std::uint32_t i : moved) {
    if (merged(fat_[i], boxes[i]) == fat_[i]) continue;
    fat_[i] = fattened(boxes[i]);
    exited_.push_back(ids_[i]);
    exited_fat_.push_back(fat_[i]);
  }
  if (!exited_.empty()) {
    world_->move(exited_, exited_fat_);
    const WorldStats stats = world_->update();
    if (stats.begun != 0 || stats.ended != 0) list_candidates();
  }
  hand_over(boxes, pairs);
}

void FatBoxes::list_candidates() {
  candidates_.clear();
  world_->stream_pairs([this](Span<const ProxyPair> held) {
    // The slots of a new World count up.
    for (const ProxyPair& pair : held) candidates_.push_back({pair.a.slot, pair.b.slot});
    return true;
  });
}

void FatBoxes::hand_over(Span<const Aabb> boxes, std::vector<Pair>& pairs) const {
  pairs.clear();
  if (tested_)
    std::copy_if(candidates_.begin(), candidates_.end(), std::back_inserter(pairs),
                 [&](Pair pair) { return overlaps(boxes[pair.a], boxes[pair.b]); });
  else
    pairs = candidates_;
}

}  // namespace boxstream::report
