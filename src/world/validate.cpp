// SPDX-License-Identifier: MIT
#include "base/check.hpp"
#include "world/core.hpp"

namespace boxstream {

using namespace detail;

template <class S>
void ProxyTable<S>::validate() const {
  const std::size_t n = boxes_.size();
  check(filters_.size() == n && users_.size() == n && ids_.size() == n && flags_.size() == n,
        "proxies: arrays of different length");
  std::size_t dead_seen = 0;
  std::uint64_t moved_seen = 0;
  std::uint64_t invalid_seen = 0;
  std::uint64_t special_seen = 0;
  std::size_t dirty_seen = 0;
  for (std::uint32_t r = 0; r < n; ++r) {
    check(ids_[r].slot < slots_.size() && ids_[r].generation != 0, "proxies: an id names nothing");
    special_seen += !is_default(filters_[r]);
    dirty_seen += is_dirty(r) && !is_dead(r);
    if (is_dead(r)) {
      ++dead_seen;
      check(!has_valid_keys(boxes_[r]), "proxies: a tombstone has a box");
      check(rank(ids_[r]) == none, "proxies: the id of a tombstone is not stale");
      continue;
    }
    check(rank(ids_[r]) == r, "proxies: a live id does not lead to its rank");
    moved_seen += (flags_[r] & moved) != 0;
    invalid_seen += !has_valid_keys(boxes_[r]);
    check(is_valid(r) == has_valid_keys(boxes_[r]), "proxies: a box is not what its flags say");
  }
  check(dead_seen == dead_count_, "proxies: wrong count of tombstones");
  check(moved_seen == moved_count_, "proxies: wrong count of moved boxes");
  check(invalid_seen == invalid_count_, "proxies: wrong count of invalid boxes");
  check(special_seen == special_filters_, "proxies: wrong count of filters");
  std::size_t live_slots = 0;
  std::size_t free_slots = 0;
  for (const Slot& slot : slots_) {
    live_slots += slot.rank != none;
    free_slots += slot.rank == none && slot.generation != 0;
  }
  check(live_slots == live(), "proxies: slots and ranks disagree");
  check(free_slots == free_slots_.size(), "proxies: wrong count of free slots");
  std::vector<bool> is_free(slots_.size());
  for (const std::uint32_t slot : free_slots_) {
    check(slot < slots_.size() && slots_[slot].rank == none && !is_free[slot], "proxies: broken list of free slots");
    is_free[slot] = true;
  }
  for (const std::uint32_t r : dirty()) {
    check(r < n && is_dirty(r), "proxies: a clean rank is listed");
    dirty_seen -= !is_dead(r);
  }
  check(dirty_seen == 0, "proxies: a dirty rank is listed twice or not at all");
  check(dirty_.size() >= n, "proxies: no room for the list of what moves");
  check(!few_.is_kept() || few_.are(boxes_, [this](std::uint32_t r) { return is_valid(r); }),
        "proxies: columns of few boxes are of others");
}

template <class S>
void BasicWorld<S>::validate() const {
  impl_->proxies_.validate();
  impl_->pairs_.validate();
  impl_->pairs_.for_each([this](PairKey key) {
    const std::uint32_t a = first_of(key);
    const std::uint32_t b = second_of(key);
    check(b < impl_->proxies_.ranks(), "pairs: a rank names nothing");
    if (impl_->is_dirty(key)) return true;
    check(impl_->proxies_.touching(a, b), "pairs: boxes of a held pair do not overlap");
    return true;
  });
  impl_->search_.fat_boxes().validate(impl_->proxies_, impl_->pairs_);
  impl_->index_.validate(impl_->proxies_);
}

#define INSTANTIATE(S)                           \
  template void ProxyTable<S>::validate() const; \
  template void BasicWorld<S>::validate() const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream
