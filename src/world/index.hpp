// SPDX-License-Identifier: MIT
#pragma once

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
    if (is_used_) bvh_.reserve_slots(slots);
    if (next_) next_->reserve_slots(slots);
  }

  void mark(std::uint32_t slot) noexcept {
    if (is_used_ || next_) mark_kept(slot);
    is_fresh_.store(false, std::memory_order_relaxed);
  }

  void clear() noexcept {
    bvh_.clear();
    next_.reset();
    is_used_ = false;
    is_fresh_.store(true, std::memory_order_relaxed);
  }

  /// Gives all memory back. The next query makes the index anew.
  void release() noexcept {
    bvh_ = Bvh<S>();
    next_.reset();
    is_used_ = false;
    is_fresh_.store(false, std::memory_order_relaxed);
  }

  const Bvh<S>& fresh(const ProxyTable<S>& proxies) const {
    if (!is_fresh_.load(std::memory_order_acquire)) {
      const std::lock_guard lock(refreshing_);
      if (!is_fresh_.load(std::memory_order_relaxed)) {
        if (is_worth_finishing()) build_part(proxies, ~std::uint64_t{0});
        if (!is_used_) mark_all(proxies.slots());
        bvh_.refresh(box_of(proxies));
        is_fresh_.store(true, std::memory_order_release);
      }
    }
    return bvh_;
  }

  void validate(const ProxyTable<S>& proxies) const { fresh(proxies).validate(box_of(proxies)); }

  /// True while there is no tree that fits the boxes, so that the next query would sort all of them. `recent` is the
  /// number of changes since the last update. Not for concurrent use.
  bool needs_tree(std::size_t recent) const { return next_ || !is_used_ || bvh_.refresh_cost(recent) > 0; }

  /// Builds a part of that tree, beside what is there. True once it is in place; a query before that does what is left.
  /// For `work` see Bvh::build_part. Not for concurrent use.
  bool build_part(const ProxyTable<S>& proxies, std::uint64_t work) const {
    if (!is_worth_finishing()) {
      auto next = std::make_unique<Bvh<S>>();
      next->reserve_slots(proxies.slots());
      next->begin_build();
      next_ = std::move(next);
    }
    if (!next_->build_part(work, box_of(proxies))) return false;
    bvh_ = std::move(*next_);
    bvh_.drop_scratch();
    next_.reset();
    is_used_ = true;
    return true;
  }

 private:
  void mark_kept(std::uint32_t slot) noexcept {
    if (is_used_) bvh_.mark(slot);
    if (next_) next_->mark(slot);
  }

  /// A tree of boxes that have nearly all moved since it was begun is none that fits.
  bool is_worth_finishing() const { return next_ && 4 * next_->marks() <= next_->slot_count(); }

  void mark_all(std::size_t slots) const {
    bvh_.reserve_slots(slots);
    for (std::uint32_t slot = 0; slot < slots; ++slot) bvh_.mark(slot);
    is_used_ = true;
  }

  static auto box_of(const ProxyTable<S>& proxies) {
    return [&proxies](std::uint32_t slot) {
      const std::uint32_t rank = proxies.rank_of_slot(slot);
      const bool has_box = rank != ProxyTable<S>::none && proxies.is_valid(rank);
      return has_box ? proxies.box(rank) : ProxyTable<S>::inert_box();
    };
  }

  mutable std::mutex refreshing_;
  mutable std::atomic<bool> is_fresh_{true};
  mutable bool is_used_ = false;  // changes are not passed on before the first query
  mutable Bvh<S> bvh_;
  mutable std::unique_ptr<Bvh<S>> next_;  // being built
};

}  // namespace boxstream::detail
