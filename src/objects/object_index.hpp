// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <mutex>

#include <boxstream/object_set.hpp>

#include "base/keys.hpp"
#include "bvh/bvh.hpp"

namespace boxstream::detail {

/// The index over a roster, by place. It is made and brought up to date by the first query that needs it, whichever
/// thread that comes from; others wait for it once. From then on until the roster changes it is read without a lock.
template <class S>
class ObjectIndex {
 public:
  using Box = BasicAabb<S>;

  /// Brings it up to date with the roster, and `known` with it.
  const Bvh<S>& fresh(const Roster<S>& roster, KnownBounds<S>& known) {
    if (!known.are_of(roster)) refresh(roster, known);
    return bvh_;
  }

  /// Whether a query is better done by a look at each box, which is counted then. A look costs 1 to 2 ns; to take a
  /// change into the index 10 to 30, to build it 100 to 200 a box. Looks are counted until they have cost as much, so
  /// that at the worst twice the cheaper way is spent; of large sets, where one query by looking takes thousands of
  /// times as long as by the index, a sixth as much.
  bool scanning_is_cheaper(const Roster<S>& roster, const KnownBounds<S>& known) {
    const std::uint64_t build = roster.places() <= small_set ? 96 : 16;
    const std::uint64_t seen = known.change.load(std::memory_order_relaxed);
    const std::uint64_t missed = std::min<std::uint64_t>(roster.last_change() - seen, roster.places());
    const std::uint64_t cost = missed * (seen != 0 ? 16 : build);
    return scanned_.fetch_add(roster.places(), std::memory_order_relaxed) + roster.places() <= cost;
  }

  /// Before places change.
  void forget(KnownBounds<S>& known) noexcept {
    bvh_.clear();
    known.change.store(0, std::memory_order_relaxed);
  }

  void validate(const Roster<S>& roster, const KnownBounds<S>& known) const {
    if (known.are_of(roster)) bvh_.validate(box_of(roster));
  }

 private:
  static auto box_of(const Roster<S>& roster) {
    return [&roster](std::uint32_t place) {
      constexpr S inf = std::numeric_limits<S>::infinity();
      const Box& box = roster.box(place);
      return has_valid_keys(box) ? box : Box{{inf, inf, inf}, {-inf, -inf, -inf}};
    };
  }

  [[gnu::noinline]] void refresh(const Roster<S>& roster, KnownBounds<S>& known) {
    const std::lock_guard lock(refreshing_);
    if (known.are_of(roster)) return;
    scanned_.store(0, std::memory_order_relaxed);
    mark(roster, known.change.load(std::memory_order_relaxed));
    bvh_.refresh(box_of(roster));
    known.box = bvh_.bounds();
    known.change.store(roster.last_change(), std::memory_order_release);
  }

  /// What has changed since the change `seen`.
  void mark(const Roster<S>& roster, std::uint64_t seen) {
    bvh_.reserve_slots(roster.places());
    if (seen < roster.first_change())
      for (std::uint32_t place = 0; place < roster.places(); ++place) bvh_.mark(place);
    else
      for (std::uint64_t i = seen; i != roster.last_change(); ++i) bvh_.mark(roster.change(i));
  }

  static constexpr std::uint32_t small_set = 16384;

  std::mutex refreshing_;
  std::atomic<std::uint64_t> scanned_{0};  // boxes looked at one by one since it was made fresh
  Bvh<S> bvh_;
};

}  // namespace boxstream::detail
