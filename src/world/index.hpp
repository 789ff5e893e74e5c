// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <mutex>

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
  }

  void mark(std::uint32_t slot) noexcept {
    if (is_used_) bvh_.mark(slot);
    is_fresh_.store(false, std::memory_order_relaxed);
  }

  void clear() noexcept {
    bvh_.clear();
    is_used_ = false;
    is_fresh_.store(true, std::memory_order_relaxed);
  }

  const Bvh<S>& fresh(const ProxyTable<S>& proxies) const {
    if (!is_fresh_.load(std::memory_order_acquire)) {
      const std::lock_guard lock(refreshing_);
      if (!is_fresh_.load(std::memory_order_relaxed)) {
        if (!is_used_) mark_all(proxies.slots());
        bvh_.refresh(box_of(proxies));
        is_fresh_.store(true, std::memory_order_release);
      }
    }
    return bvh_;
  }

  void validate(const ProxyTable<S>& proxies) const { fresh(proxies).validate(box_of(proxies)); }

  /// See Bvh::refresh_cost. Not for concurrent use.
  std::size_t refresh_cost(std::size_t slots, std::size_t recent) const {
    return is_used_ ? bvh_.refresh_cost(recent) : slots;
  }

 private:
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
};

}  // namespace boxstream::detail
