// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

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

/// The pairs that a World holds: one sorted flat array, which updates replace as a whole, and two short sorted side
/// lists for what begins or is released one by one in between.
class HeldPairs {
 public:
  bool contains(PairKey key) const;
  std::uint64_t size() const { return keys_.size() + added_.size() - removed_.size(); }

  /// The key is not held yet.
  void add(PairKey key);
  /// False if the key is not held. A released key is doubtful from then on.
  bool release(PairKey key);

  /// Merges the side lists into the array and returns it. Changes nothing that can be observed.
  const std::vector<PairKey>& fold();

  /// Pairs that are not held although no later change may reveal that they overlap: released ones, and those that a
  /// callback refused. Unsorted; may repeat itself and may name pairs that are held again.
  const std::vector<PairKey>& doubtful() const { return doubtful_; }

  /// Installs the outcome of an update by swapping; the arguments get the old contents. The side lists must be folded.
  void replace(std::vector<PairKey>& keys, std::vector<PairKey>& doubtful) noexcept;

  /// Ranks changed, in order. No held pair may name a dropped rank; doubtful ones that do are forgotten.
  void remap(Span<const std::uint32_t> new_rank) noexcept;

  void clear() noexcept;

  /// Calls `visit(key)` in order until it returns false.
  template <class Visit>
  void for_each(Visit&& visit) const {
    auto add = added_.begin();
    auto remove = removed_.begin();
    for (const PairKey key : keys_) {
      for (; add != added_.end() && *add < key; ++add)
        if (!visit(*add)) return;
      if (remove != removed_.end() && *remove == key) {
        ++remove;
        continue;
      }
      if (!visit(key)) return;
    }
    for (; add != added_.end(); ++add)
      if (!visit(*add)) return;
  }

  /// Throws std::logic_error naming the first broken invariant.
  void validate() const;

 private:
  std::vector<PairKey> keys_;
  std::vector<PairKey> added_;    // disjoint from keys_
  std::vector<PairKey> removed_;  // part of keys_
  std::vector<PairKey> doubtful_;
  std::vector<PairKey> scratch_;
};

/// Sorts pairs of ranks by key, in time proportional to their number; keeps its scratch.
class PairSorter {
 public:
  /// `out` gets the keys of `pairs` (a < b < ranks), sorted, repetitions included.
  void sort(Span<const Pair> pairs, std::size_t ranks, std::vector<PairKey>& out);

 private:
  std::vector<PairKey> scratch_;
  std::vector<std::size_t> counts_;
};

}  // namespace boxstream::detail
