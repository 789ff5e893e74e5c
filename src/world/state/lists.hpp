// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>
#include <boxstream/splice.hpp>

#include "base/bits.hpp"
#include "world/state/update_threads.hpp"

namespace boxstream::detail {

/// Two ranks in one word, the smaller in the upper half: sorted keys are pairs in order of creation.
using PairKey = std::uint64_t;

constexpr PairKey pair_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? PairKey{a} << 32 | b : PairKey{b} << 32 | a;
}
constexpr std::uint32_t first_of(PairKey key) {
  return static_cast<std::uint32_t>(key >> 32);
}
constexpr std::uint32_t second_of(PairKey key) {
  return static_cast<std::uint32_t>(key);
}

/// Pairs in order, as two arrays of ranks with `slack` elements behind the pairs: vectors may read and write beyond the
/// end.
struct PairColumns {
  static constexpr std::size_t slack = 64;

  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> second;

  /// For `pairs` pairs and the slack; may throw.
  void make_room(std::size_t pairs);

  PairKey key_at(std::size_t i) const { return PairKey{first[i]} << 32 | second[i]; }
};

/// A set of pairs of ranks (first < second), in order, and where the list of each first rank begins.
///
/// An update goes: `expect_...`, `confirm` with what a search finds, `find_missing`, `exchange`. Pairs that persist,
/// which are nearly all, are looked up in a short list and never sorted; only pairs that begin or end are spliced.
class PairLists {
 public:
  /// Pairs that fit; std::length_error beyond.
  static constexpr std::uint64_t most = (std::uint64_t{1} << 32) - PairColumns::slack;

  std::uint64_t size() const { return size_; }
  bool contains(PairKey key) const;

  /// The index of a pair, or where it would be inserted.
  std::size_t place(PairKey key) const;
  /// The indices of pairs of the set. May throw.
  void find_places(Span<const PairKey> pairs, std::vector<std::uint32_t>& places) const;

  /// Room for lists of all ranks below `ranks`. May throw, and is needed before the rest.
  void reserve_ranks(std::size_t ranks);

  /// All pairs are expected, those with a rank on the list, or none. May throw.
  void expect_all();
  void expect_of(Span<const std::uint32_t> ranks);
  void expect_none();

  /// Pairs that were found: the expected ones among them are no longer expected, and those that are not in the set are
  /// appended to `fresh`. May throw.
  void confirm(Span<const Pair> found, const UpdateThreads& threads, std::vector<Pair>& fresh);

  /// Calls `is_gone(key)` in order for each pair that is still expected. `gone` gets the indices of those for which it
  /// returns true. May throw.
  template <class IsGone>
  void find_missing(IsGone&& is_gone, std::vector<std::uint32_t>& gone) const;

  /// Removes the pairs at the indices `gone` and inserts `added`, both sorted; `arrived` gets the new indices. May
  /// throw, and has then done nothing.
  void exchange(Span<const std::uint32_t> gone, Span<const PairKey> added, std::vector<std::uint32_t>& arrived);

  /// All that instead, after a search of all whose pairs are few: `found` has each pair once, in any order. `begun`
  /// gets those that are not in the set, in order, with the indices that they will have; `ended` those that are no
  /// longer found, with their present ones. May throw. Then `take_merged`, with nothing in between, makes the set that
  /// of the found ones.
  void merge(Span<const Pair> found, std::vector<PairKey>& begun, std::vector<std::uint32_t>& begun_places,
             std::vector<PairKey>& ended, std::vector<std::uint32_t>& ended_places);
  void take_merged() noexcept;

  /// Ranks changed, in order; those that map to `dropped` are in no pair.
  void remap(Span<const std::uint32_t> new_rank, std::uint32_t dropped) noexcept;

  void clear() noexcept;

  /// For how many pairs there is memory.
  std::size_t room() const { return pairs_.second.size() + next_.second.size(); }
  /// Gives memory back that these pairs do not need.
  void give_back() noexcept;
  /// The same, for ranks too.
  void shrink_to_fit();

  /// Calls `visit(key)` in order until it returns false; returns whether it never did.
  template <class Visit>
  bool for_each(Visit&& visit) const {
    for (std::size_t i = 0; i < size_; ++i)
      if (!visit(key_at(i))) return false;
    return true;
  }

  /// Calls `visit(key)` for each pair of this rank. All second ranks before its list are looked at.
  template <class Visit>
  void for_each_of(std::uint32_t rank, Visit&& visit) const {
    if (rank >= ranks()) return;
    for_each_with_second(rank, [&](std::size_t i) { visit(key_at(i)); });
    for (std::size_t i = starts_[rank]; i < starts_[rank + 1]; ++i) visit(key_at(i));
  }

  /// All pairs, in order.
  Span<const std::uint32_t> firsts() const { return {pairs_.first.data(), size_}; }
  Span<const std::uint32_t> seconds() const { return {pairs_.second.data(), size_}; }

  /// Throws std::logic_error naming the first broken invariant.
  void validate() const;

 private:
  std::size_t ranks() const { return starts_.empty() ? 0 : starts_.size() - 1; }
  std::size_t words() const { return (size_ + 63) / 64; }
  /// Of 64 pairs each: those that have a pair with this second rank, which are in the lists of smaller ones.
  std::size_t groups_before(std::uint32_t rank) const { return (std::size_t{starts_[rank]} + 63) / 64; }
  std::size_t next_group_with(std::uint32_t second, std::size_t first) const;
  /// Calls `visit(i)` for the index of each pair that has this second rank.
  template <class Visit>
  void for_each_with_second(std::uint32_t rank, Visit&& visit) const {
    const std::size_t groups = groups_before(rank);
    for (std::size_t group = 0; (group = next_group_with(rank, group)) < groups; ++group)
      for (std::size_t i = 64 * group; i < 64 * group + 64; ++i)
        if (pairs_.second[i] == rank) visit(i);
  }
  PairKey key_at(std::size_t i) const { return pairs_.key_at(i); }
  void confirm(Span<const Pair> found, std::vector<std::uint64_t>& expected, std::vector<Pair>& fresh) const;
  void mark_listed(Span<const std::uint32_t> listed);
  void lay_lists(Span<const Pair> found);
  void copy_runs(const Splice& splice) noexcept;
  void shift_starts(Span<const std::uint32_t> gone, Span<const PairKey> added) noexcept;
  void find_starts() noexcept;

  std::size_t size_ = 0;
  PairColumns pairs_;
  std::vector<std::uint32_t> starts_;    // of each rank's list; one more at the end
  std::vector<std::uint64_t> expected_;  // a bit for each pair, and a word more

  /// Of what was found, what one thread looks up.
  struct Part {
    std::vector<std::uint64_t> expected;
    std::vector<Pair> fresh;
  };

  // Scratch, kept for its memory.
  std::vector<Part> parts_;
  PairColumns next_;
  std::vector<std::uint32_t> next_starts_;
  std::vector<std::uint8_t> is_listed_;  // for each rank, if it has been listed; all false between calls
};

template <class IsGone>
void PairLists::find_missing(IsGone&& is_gone, std::vector<std::uint32_t>& gone) const {
  assert(expected_.size() == words() + 1);
  gone.clear();
  for (std::size_t w = 0; w < words(); ++w)
    for_each_bit(expected_[w], [&](unsigned bit) {
      const std::size_t place = 64 * w + bit;
      if (is_gone(key_at(place))) gone.push_back(static_cast<std::uint32_t>(place));
    });
}

}  // namespace boxstream::detail
