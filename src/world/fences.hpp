// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/detector.hpp>
#include <boxstream/function_ref.hpp>

#include "index/bvh.hpp"
#include "world/pairs.hpp"
#include "world/proxies.hpp"

namespace boxstream::detail {

/// Candidates that outlive updates, for worlds whose boxes move little at a time.
///
/// Each proxy has a fence: a box that contained its own when the fence was raised, larger on all sides by a skin. While
/// all boxes are inside their fences, the pairs of overlapping fences, the candidates, contain all overlapping pairs.
/// So a search is one pass over the candidates, in key order, with the exact comparison; only for proxies that have
/// left their fence candidates are looked for anew. Each candidate knows whether it is held as a pair, so that what
/// begins and what ends shows in that pass, and nothing else has to be told. That a fence contains its box is found out
/// by comparing, and skins take part in no other decision: the outcome is that of a batch of all.
///
/// Skins tune themselves: a fence that was left soon is raised again with a wider one, one that lasted long with a
/// narrower one. As long as the candidates are not kept, the fences of a sample of the proxies tell how many would be
/// left in each update, and so whether keeping them would pay.
template <class S>
class Fences {
 public:
  using Box = BasicAabb<S>;

  /// Takes notice of the ranks touched since the last update. To be called once in each update, before the rest.
  /// std::bad_alloc leaves fences of which the next call takes notice.
  void notice(const ProxyTable<S>& proxies);

  /// What `search` costs now if candidates are kept, or would cost in each update if they were; in boxes of a batch of
  /// all. `pairs` is how many the last update found.
  std::size_t price(const ProxyTable<S>& proxies, std::size_t pairs) const;

  /// The same, if from now on as many proxies as lately leave their fence in each update.
  std::size_t lasting_price(const ProxyTable<S>& proxies, std::size_t pairs) const;

  /// True while candidates are kept.
  bool stand() const { return stand_; }

  /// What differs between the held pairs and those that overlap and that group and mask accept: fills `begun` with the
  /// keys that are not held and name a touched proxy, and `ended` with those that are to be held no longer, neither in
  /// order. Keeps candidates from now on, and takes `begun` for held and `ended` for not held, unless `held_changed`
  /// says otherwise. With `sticky_filters`, held pairs end only by parting.
  ///
  /// False if there are more than `most_candidates`. Then, and after std::bad_alloc, no candidates are kept, and what
  /// was filled in is of no use.
  bool search(const ProxyTable<S>& proxies, const PairLists& held, bool sticky_filters, Detector& detector,
              std::vector<PairKey>& begun, std::vector<PairKey>& ended, Stats& stats);

  /// A pair is held, or is not any more, without `search` having said so. Without memory, keeps candidates no longer.
  void held_changed(PairKey key) noexcept { held_changed(Span<const PairKey>(&key, 1)); }
  void held_changed(Span<const PairKey> keys) noexcept;

  /// What bounds the memory: fences of boxes that are long, thin and close together can all overlap where no boxes do.
  /// A candidate takes 8 bytes, and about 32 more of scratch that are kept for the next time.
  static constexpr std::size_t most_candidates(std::size_t ranks, std::size_t pairs) { return 8 * ranks + 2 * pairs; }

  /// More proxies than this have no candidates.
  static constexpr std::size_t most_ranks = std::size_t{1} << 31;

  /// Keeps no candidates any more.
  void drop() noexcept;

  /// Ranks changed, in order; dropped ones are `ProxyTable::none`.
  void remap(Span<const std::uint32_t> new_rank) noexcept;

  void clear() noexcept;

  /// Throws std::logic_error naming the first broken invariant. Every touched rank must have been noticed.
  void validate(const ProxyTable<S>& proxies, const HeldPairs& held) const;

 private:
  /// Key and, in the lowest bit, whether the pair is held: in the order of keys.
  using Candidate = std::uint64_t;
  static PairKey key_of(Candidate candidate) { return candidate >> 1; }
  static bool is_held(Candidate candidate) { return (candidate & 1) != 0; }

  /// What a search works with.
  struct Task {
    const ProxyTable<S>& proxies;
    const PairLists& held;
    bool sticky_filters;
    std::size_t most;  // candidates
    std::vector<PairKey>& begun;
    std::vector<PairKey>& ended;
  };

  void grow_to(std::size_t ranks);
  void escape(std::uint32_t rank);
  void raise(std::uint32_t rank, const Box& box);
  void raise_all(const ProxyTable<S>& proxies);
  std::size_t price(const ProxyTable<S>& proxies, std::size_t candidates, double escaped) const;
  bool renew_all(const Task& task, Detector& detector, Stats& stats);
  void mark_held(const Task& task);
  bool renew_escaped(const Task& task);
  bool probe_escaped(const Task& task);
  void correct_changed(const PairLists& held);
  void add_fresh();
  std::size_t place(PairKey key) const;
  void purge(const Task& task);
  void pass(std::vector<Candidate>& candidates, const Task& task);
  void index_rows(std::size_t ranks);

  bool stand_ = false;
  std::uint32_t update_ = 0;
  double escape_rate_ = 1;  // proxies that leave their fence, of all, in an update; a running mean

  // Of each rank.
  std::vector<Box> fences_;
  std::vector<S> skins_;
  std::vector<std::uint32_t> raised_;  // in which update; 0: never
  std::vector<std::uint8_t> has_escaped_;

  Bvh<S> index_;  // of the fences, by rank
  bool is_indexed_ = false;

  std::vector<std::uint32_t> escaped_;
  std::size_t escaped_since_purge_ = 0;
  bool must_purge_ = false;  // a candidate names a proxy without a box, or was made with other filters

  std::vector<Candidate> candidates_;  // sorted; the fences of some may have parted
  std::vector<std::uint32_t> rows_;    // where the candidates begin whose first rank is this one
  std::vector<Candidate> recent_;      // sorted; candidates as well, but found after the others
  std::vector<PairKey> changed_;       // held or not, other than the candidate says

  // Scratch.
  std::vector<Candidate> fresh_;
  std::vector<Candidate> merged_;
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> asking_;
  std::vector<Box> asking_fences_;
  BatchWalk<S> walk_;
  PairSorter sorter_;
};

}  // namespace boxstream::detail
