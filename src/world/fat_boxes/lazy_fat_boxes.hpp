// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "world/fat_boxes/fat_boxes.hpp"

namespace boxstream::detail {

/// Fat boxes that are there once they are needed: many worlds stay small, and are made and dropped often. Until then
/// there are no candidates, so that there is nothing to be told or dropped.
template <class S>
class LazyFatBoxes {
 public:
  /// May throw the first time.
  FatBoxes<S>& make() {
    if (!fat_boxes_) fat_boxes_ = std::make_unique<FatBoxes<S>>();
    return *fat_boxes_;
  }

  bool is_active() const { return fat_boxes_ && fat_boxes_->is_active(); }
  CandidateState state() const { return fat_boxes_ ? fat_boxes_->state() : CandidateState(); }

  template <class Keys>
  void held_changed(const Keys& keys) noexcept {
    if (fat_boxes_) fat_boxes_->held_changed(keys);
  }
  void remap(Span<const std::uint32_t> new_rank) noexcept {
    if (fat_boxes_) fat_boxes_->remap(new_rank);
  }
  void give_back() noexcept {
    if (fat_boxes_) fat_boxes_->give_back();
  }
  void drop() noexcept {
    if (fat_boxes_) fat_boxes_->drop();
  }
  void clear() noexcept {
    if (fat_boxes_) fat_boxes_->clear();
  }
  void validate(const ProxyTable<S>& proxies, const HeldPairs& held) const {
    if (fat_boxes_) fat_boxes_->validate(proxies, held);
  }

 private:
  std::unique_ptr<FatBoxes<S>> fat_boxes_;
};

}  // namespace boxstream::detail
