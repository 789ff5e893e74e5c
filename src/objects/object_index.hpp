// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <mutex>
#include <vector>

#include <boxstream/object_set.hpp>

#include "base/keys.hpp"
#include "base/thresholds.hpp"
#include "bvh/bvh.hpp"

namespace boxstream::detail {

/// The index of an object table, by place. The first query that needs it makes it or brings it up to date, on any
/// thread; concurrent queries wait for that. After that, until the table changes, it is read without a lock.
template <class S>
class ObjectIndex {
 public:
  using Box = BasicAabb<S>;

  /// The index, brought up to date together with `known`.
  const Bvh<S>& fresh(const ObjectTable<S>& table, KnownBounds<S>& known) {
    if (!known.are_of(table)) refresh(table, known);
    return bvh_;
  }

  /// True if a scan of all boxes is cheaper for the next query; that scan is counted then. A scan takes 1 to 2 ns a
  /// box, a refit 10 to 30 ns a change, a build 100 to 200 ns a box. Scans are chosen until they have cost as much as
  /// the refresh, so that the total is at most twice that of the better choice. For large sets the limit
  /// is a sixth of that. `boxes` is what the scan is worth, in boxes.
  bool scanning_is_cheaper(const ObjectTable<S>& table, const KnownBounds<S>& known, std::uint64_t boxes) {
    const std::uint64_t build = table.places() <= thresholds.small_set ? 96 : 16;
    const std::uint64_t seen = known.change.load(std::memory_order_relaxed);
    const std::uint64_t missed = std::min<std::uint64_t>(table.last_change() - seen, table.places());
    const std::uint64_t cost = missed * (seen != 0 ? 16 : build);
    return scanned_.fetch_add(boxes, std::memory_order_relaxed) + boxes <= cost;
  }

  /// When places are about to change: the first change of the table that it has not seen; 0 if there is nothing that
  /// could follow.
  std::uint64_t seen(const ObjectTable<S>& table, const KnownBounds<S>& known) const {
    const std::uint64_t seen = known.change.load(std::memory_order_relaxed);
    return seen < table.first_change() || bvh_.has_marks() ? 0 : seen;
  }
  /// Places change.
  void follow(const std::vector<std::uint32_t>& to) noexcept { bvh_.rename_slots(to); }

  void forget(KnownBounds<S>& known) noexcept {
    bvh_.clear();
    known.change.store(0, std::memory_order_relaxed);
  }

  void validate(const ObjectTable<S>& table, const KnownBounds<S>& known) const {
    if (known.are_of(table)) bvh_.validate(box_of(table));
  }

 private:
  static auto box_of(const ObjectTable<S>& table) {
    return [&table](std::uint32_t place) {
      constexpr S inf = std::numeric_limits<S>::infinity();
      const Box& box = table.box(place);
      return has_valid_keys(box) ? box : Box{{inf, inf, inf}, {-inf, -inf, -inf}};
    };
  }

  [[gnu::noinline]] void refresh(const ObjectTable<S>& table, KnownBounds<S>& known) {
    const std::lock_guard lock(refreshing_);
    if (known.are_of(table)) return;
    scanned_.store(0, std::memory_order_relaxed);
    mark(table, known.change.load(std::memory_order_relaxed));
    bvh_.refresh(box_of(table));
    bvh_.drop_scratch();  // few sets have all their boxes moved and an index as well
    known.box = bvh_.bounds();
    known.change.store(table.last_change(), std::memory_order_release);
  }

  /// Marks what changed after the change `seen`.
  void mark(const ObjectTable<S>& table, std::uint64_t seen) {
    bvh_.reserve_slots(table.places());
    if (seen < table.first_change())
      for (std::uint32_t place = 0; place < table.places(); ++place) bvh_.mark(place);
    else
      for (std::uint64_t i = seen; i != table.last_change(); ++i)
        if (table.change(i) != ObjectTable<S>::none) bvh_.mark(table.change(i));
  }

  std::mutex refreshing_;
  std::atomic<std::uint64_t> scanned_{0};  // boxes scanned since the last refresh
  Bvh<S> bvh_{thresholds.few_without_tree};
};

}  // namespace boxstream::detail
