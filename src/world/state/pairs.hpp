// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

#include "world/state/lists.hpp"

namespace boxstream::detail {

/// The pairs that a World holds: flat lists, which updates change as a whole, and two short sorted side lists for what
/// begins or ends in updates of few proxies, or one by one in between. So to begin one pair does not move all others.
class HeldPairs {
 public:
  bool contains(PairKey key) const;
  std::uint64_t size() const { return lists_.size() + added_.size() - removed_.size(); }

  /// How many held pairs come before this one.
  std::size_t place(PairKey key) const;

  /// Of a key that is not held.
  void add(PairKey key);
  /// Returns whether the key was held. Adds it to `recheck` in either case.
  bool release(PairKey key);

  /// The places of pairs that are held. May throw.
  void find_places(Span<const PairKey> keys, std::vector<std::uint32_t>& places) const;

  /// Of an update of few proxies: like PairLists::exchange, with `gone` at its places, by the side lists. May throw,
  /// and has then done nothing.
  void exchange_few(Span<const PairKey> gone, Span<const std::uint32_t> places, Span<const PairKey> added,
                    std::vector<std::uint32_t>& arrived);

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
    for_each_run([&](const std::uint32_t* first, const std::uint32_t* second, std::size_t count) {
      for (std::size_t i = 0; i < count; ++i)
        if (!visit(PairKey{first[i]} << 32 | second[i])) return false;
      return true;
    });
  }

  /// Calls `visit(firsts, seconds, count)` for runs of pairs, in order, until it returns false.
  template <class Visit>
  void for_each_run(Visit&& visit) const {
    const std::uint32_t *const firsts = lists_.firsts().data(), *const seconds = lists_.seconds().data();
    std::size_t from = 0;
    const auto run_to = [&](std::size_t to) { return to == from || visit(firsts + from, seconds + from, to - from); };
    auto add = added_.begin(), remove = removed_.begin();
    while (add != added_.end() || remove != removed_.end()) {
      const bool adds = remove == removed_.end() || (add != added_.end() && *add < *remove);
      const PairKey key = adds ? *add++ : *remove++;
      const std::uint32_t first = first_of(key), second = second_of(key);
      const std::size_t at = lists_.place(key);
      if (!run_to(at) || (adds && !visit(&first, &second, std::size_t{1}))) return;
      from = at + !adds;
    }
    run_to(lists_.firsts().size());
  }

  /// Calls `visit(key)` for each pair of this rank.
  template <class Visit>
  void for_each_of(std::uint32_t rank, Visit&& visit) const {
    lists_.for_each_of(rank, [&](PairKey key) {
      if (!std::binary_search(removed_.begin(), removed_.end(), key)) visit(key);
    });
    for (const PairKey key : added_)
      if (first_of(key) == rank || second_of(key) == rank) visit(key);
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
