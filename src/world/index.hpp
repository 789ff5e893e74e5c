// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

#include "bvh/bvh.hpp"
#include "world/state/proxies.hpp"

namespace boxstream::detail {

/// The index behind the queries of a World, brought up to date by the first query after changes, whichever thread it
/// comes from; the others wait for it once. Queries of a fresh index take no lock.
template <class S>
class LazyIndex {
 public:
  void reserve_slots(std::size_t slots) {
    if (bvh_) bvh_->reserve_slots(slots);
    if (next_) next_->reserve_slots(slots);
  }

  void mark(std::uint32_t slot) noexcept {
    if (bvh_) bvh_->mark(slot);
    if (next_) next_->mark(slot);
    asked_.store(0, std::memory_order_relaxed);
  }

  /// Gives all memory back. The next query makes the index anew.
  void release() noexcept {
    bvh_.reset();
    next_.reset();
    spent_ = lost_ = 0;
    hurried_ = 0;
    is_hurried_ = false;
    asked_.store(0, std::memory_order_relaxed);
  }

  const Bvh<S>& fresh(const ProxyTable<S>& proxies) const {
    if (asked_.load(std::memory_order_acquire) != fresh_now) {
      const std::lock_guard lock(refreshing_);
      if (asked_.load(std::memory_order_relaxed) != fresh_now) {
        if (next_ && !is_worth_finishing()) give_up_next();
        if (next_ && !is_ready(0)) build_part(proxies, ~std::uint64_t{0}, 0);
        if (!bvh_) mark_all(proxies.slots());
        bvh_->refresh(box_of(proxies));
        asked_.store(fresh_now, std::memory_order_release);
      }
    }
    return *bvh_;
  }

  /// For a query that can do without: true if the index is fresh, or so many have been asked since a change that it had
  /// better be.
  bool is_worth_asking(std::uint32_t patience) const {
    std::uint32_t asked = asked_.load(std::memory_order_relaxed);
    if (asked >= patience) return true;
    asked_.compare_exchange_strong(asked, asked + 1, std::memory_order_relaxed);  // another may have made it fresh
    return false;
  }

  void validate(const ProxyTable<S>& proxies) const { fresh(proxies).validate(box_of(proxies)); }

  /// True while there is a tree that fits the boxes: otherwise the next query would sort all of them. `recent` is the
  /// number of changes since the last update. Not for concurrent use.
  bool is_ready(std::size_t recent) const { return bvh_ && bvh_->refresh_cost(recent) == 0; }
  /// True for one that fits, but will not for long, as boxes come that it has no place for.
  bool is_worn() const { return next_ || bvh_->is_worn(); }

  /// Builds a part of a new tree, beside what is there. True once it is in place; a query before that does what is
  /// left, if it cannot do with what is there. For `work` see Bvh::build_part. Not for concurrent use. The new tree has
  /// what was marked meanwhile still to take in, even if the one before it was fresh.
  ///
  /// Once so much has been spent on trees that changes overtook that it would have made one, the parts become as large
  /// as it takes to be in time with `recent` changes at each call. Twice as much has to be spent before the next time,
  /// for where boxes jump such a tree does not last.
  bool build_part(const ProxyTable<S>& proxies, std::uint64_t work, std::size_t recent) const {
    const std::uint64_t whole = Bvh<S>::work_of_build(proxies.slots());
    if (next_ && !is_worth_finishing()) give_up_next();
    if (!next_) {
      auto next = std::make_unique<Bvh<S>>();
      next->reserve_slots(proxies.slots());
      next->begin_build(bvh_ && bvh_->lacks_room());
      next_ = std::move(next);
    }
    const std::uint64_t in_time = whole / calls_to_finish(recent);
    if (lost_ >= whole << hurried_ && work < in_time && in_time <= most_hurry * work) {
      work = in_time;
      is_hurried_ = true;
    }
    spent_ += std::min(work, whole);
    if (!next_->build_part(work, box_of(proxies))) return false;
    bvh_ = std::move(next_);
    bvh_->drop_scratch();
    asked_.store(0, std::memory_order_relaxed);
    lost_ = spent_ = 0;
    hurried_ = std::exchange(is_hurried_, false) ? std::min(hurried_ + 1, most_hurried) : 0;
    return true;
  }

 private:
  static constexpr std::uint32_t fresh_now = ~std::uint32_t{0};
  static constexpr unsigned most_hurried = 4;
  static constexpr std::uint64_t most_hurry = 5;  // by which a part is larger: updates should not be seen

  /// No longer, once more than a quarter of its boxes have moved since it was begun.
  bool is_worth_finishing() const { return 4 * next_->marks() <= next_->slot_count(); }
  void give_up_next() const noexcept {
    next_.reset();
    lost_ += std::exchange(spent_, 0);
    if (!std::exchange(is_hurried_, false)) return;
    // It was in vain.
    lost_ = 0;
    hurried_ = std::min(hurried_ + 1, most_hurried);
  }
  /// Before that, if each has so many changes.
  std::uint64_t calls_to_finish(std::size_t recent) const {
    return std::max<std::uint64_t>(1, next_->slot_count() / (5 * std::max<std::size_t>(1, recent)));
  }

  void mark_all(std::size_t slots) const {
    auto bvh = std::make_unique<Bvh<S>>();
    bvh->reserve_slots(slots);
    for (std::uint32_t slot = 0; slot < slots; ++slot) bvh->mark(slot);
    bvh_ = std::move(bvh);
  }

  static auto box_of(const ProxyTable<S>& proxies) {
    return [&proxies](std::uint32_t slot) {
      const std::uint32_t rank = proxies.rank_of_slot(slot);
      const bool has_box = rank != ProxyTable<S>::none && proxies.is_valid(rank);
      return has_box ? proxies.box(rank) : ProxyTable<S>::inert_box();
    };
  }

  mutable std::mutex refreshing_;
  mutable std::atomic<std::uint32_t> asked_{0};  // queries since a change that did without, or `fresh_now`
  mutable std::unique_ptr<Bvh<S>> bvh_;          // made by the first query: until then changes are not passed on
  mutable std::unique_ptr<Bvh<S>> next_;         // being built
  mutable std::uint64_t spent_ = 0, lost_ = 0;   // work on that one, and on those that were given up
  mutable unsigned hurried_ = 0;                 // trees made in a hurry, one after the other
  mutable bool is_hurried_ = false;              // the one being built
};

}  // namespace boxstream::detail
