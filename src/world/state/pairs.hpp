// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

#include "world/state/lists.hpp"

namespace boxstream::detail {

/// The pairs that a World holds: flat lists, which updates change as a whole, and two short sorted side lists for what
/// begins or is released one by one in between.
class HeldPairs {
 public:
  bool contains(PairKey key) const;
  std::uint64_t size() const { return lists_.size() + added_.size() - removed_.size(); }

  /// How many held pairs come before this one.
  std::size_t place(PairKey key) const;

  /// Of a key that is not held.
  void add(PairKey key);
  /// Of some pairs, both in order: `gone` ones are held and end, `added` ones are not and begin. The places are those
  /// of before and of after. May throw, and has then done nothing that can be observed.
  void change(Span<const PairKey> gone, Span<const PairKey> added, std::vector<std::uint32_t>& gone_places,
              std::vector<std::uint32_t>& added_places);
  /// Returns whether the key was held. Adds it to `recheck` in either case.
  bool release(PairKey key);

  /// Merges the side lists into the others. Changes nothing that can be observed.
  void fold() {
    if (!is_folded()) fold_sides();
  }

  /// For updates to work on.
  PairLists& lists() {
    assert(is_folded());
    return lists_;
  }
  /// Changes whenever the pairs do; one that changes the lists says so.
  std::uint64_t edition() const { return edition_; }
  void lists_changed() noexcept { ++edition_; }
  bool is_folded() const { return added_.empty() && removed_.empty(); }

  /// Pairs released since the last update: they may have to begin although neither proxy is dirty. Unsorted; with
  /// duplicates, and with pairs that are held again.
  const std::vector<PairKey>& recheck() const { return recheck_; }
  void clear_recheck() noexcept { recheck_.clear(); }

  /// Ranks changed, in order. No held pair may have a dropped rank; pairs to recheck that have one are dropped.
  void remap(Span<const std::uint32_t> new_rank) noexcept;

  void clear() noexcept;

  /// Calls `visit(key)` in order until it returns false.
  template <class Visit>
  void for_each(Visit&& visit) const {
    if (is_folded()) {
      lists_.for_each(visit);
      return;
    }
    auto add = added_.begin();
    auto remove = removed_.begin();
    const bool going_on = lists_.for_each([&](PairKey key) {
      for (; add != added_.end() && *add < key; ++add)
        if (!visit(*add)) return false;
      if (remove != removed_.end() && *remove == key) {
        ++remove;
        return true;
      }
      return static_cast<bool>(visit(key));
    });
    if (!going_on) return;
    for (; add != added_.end(); ++add)
      if (!visit(*add)) return;
  }

  std::size_t room() const { return lists_.room(); }
  void give_back() noexcept { lists_.give_back(); }
  /// The same, with all scratch. Only if `is_folded()`.
  void shrink_to_fit() {
    assert(is_folded());
    lists_.shrink_to_fit();
    for (auto* side : {&added_, &removed_, &recheck_}) side->shrink_to_fit();
    for (auto* places : {&gone_, &arrived_}) std::vector<std::uint32_t>().swap(*places);
  }

  /// Throws std::logic_error naming the first broken invariant.
  void validate() const;

 private:
  void fold_sides();
  bool take(PairKey key);

  PairLists lists_;
  std::uint64_t edition_ = 1;
  std::vector<PairKey> added_;    // not in lists_
  std::vector<PairKey> removed_;  // in lists_
  std::vector<PairKey> recheck_;
  std::vector<std::uint32_t> gone_, arrived_;  // scratch
};

/// Sorts pairs of ranks by key, in time proportional to their number; keeps its scratch.
class PairSorter {
 public:
  /// `out` gets the keys of `pairs` (a < b < ranks), sorted, repetitions included.
  void sort(Span<const Pair> pairs, std::size_t ranks, std::vector<PairKey>& out);
  void give_back() noexcept { std::vector<PairKey>().swap(scratch_); }

 private:
  std::vector<PairKey> scratch_;
  std::vector<std::size_t> counts_;
};

}  // namespace boxstream::detail
