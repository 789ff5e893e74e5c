// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/detector.hpp>
#include <boxstream/function_ref.hpp>

#include "bvh/bvh.hpp"
#include "world/fences/motion.hpp"
#include "world/state/pairs.hpp"
#include "world/state/proxies.hpp"

namespace boxstream::detail {

/// Candidates that outlive updates, for worlds whose boxes move little at a time.
///
/// Each proxy has a fence: a box that contained its own when the fence was raised, larger on all sides by a skin. While
/// all boxes are inside their fences, the pairs of overlapping fences, the candidates, contain all overlapping pairs.
/// So a search is one pass over the candidates with the exact comparison, and only for proxies that have left their
/// fence candidates are looked for anew; or a search of all fences renews them all. Each candidate knows whether it is
/// held as a pair, so that what begins and what ends shows in that pass. That a fence contains its box is found out
/// by comparing, and skins take part in no other decision: the outcome is that of a batch of all.
///
/// Each box has a core as well, smaller by the skin, and counts as escaped too when it does not contain its core any
/// more. So pairs whose cores overlap are sure to overlap as long as neither escapes, and the pass leaves them out.
/// (A core may be inside out: what counts is that the lower end of the box is at most that of the core, and so on.)
/// Where boxes go so far that few pairs would be sure, there are no cores.
///
/// All fences may drift by one vector, so that a world that moves as a whole does not leave them: fences that are apart
/// are apart wherever they drift, because adding is monotone. Sums are rounded, so while they drift a box must be
/// inside, not at the edge: what is less than another after rounding was less before.
template <class S>
class Fences {
 public:
  using Box = BasicAabb<S>;

  /// Takes notice of the ranks touched since the last update. To be called once in each update, before the rest.
  /// std::bad_alloc leaves fences of which the next call takes notice.
  void notice(const ProxyTable<S>& proxies);

  /// What an update costs if candidates are kept; in boxes of a batch of all. `pairs` is how many the last update
  /// found. As long as none are kept: what it would cost on average, or too much if that is not known.
  std::size_t price(const ProxyTable<S>& proxies, std::size_t pairs) const;

  /// True while candidates are kept.
  bool stand() const { return stand_; }

  /// True if `renew` should come before `search` could pay again. It has to if `stand()` is false.
  bool are_worn(const ProxyTable<S>& proxies, std::size_t pairs) const;

  /// Searches all fences, new ones, and keeps the pairs as candidates from now on. `sink` gets those that overlap and
  /// that group and mask accept; they are taken for held and all others for not held, unless `held_changed` says
  /// otherwise.
  ///
  /// False if there are more than `most_candidates`. Then, and after an exception, all are to be dropped.
  bool renew(const ProxyTable<S>& proxies, std::size_t pairs, Detector& detector,
             FunctionRef<void(Span<const Pair>)> sink, Stats& stats);

  /// What differs between the held pairs and those that overlap and that group and mask accept: fills `begun` with the
  /// keys that are not held and name a touched proxy, and `ended` with those that are to be held no longer, neither in
  /// order. Takes `begun` for held and `ended` for not held, unless `held_changed` says otherwise. With
  /// `sticky_filters`, held pairs end only by parting. Candidates must be kept.
  ///
  /// False as for `renew`, and what was filled in is of no use then.
  bool search(const ProxyTable<S>& proxies, const PairLists& held, bool sticky_filters, std::vector<Pair>& begun,
              std::vector<Pair>& ended);

  /// A pair is held, or is not any more, without these having said so. Without memory, keeps candidates no longer.
  void held_changed(PairKey key) noexcept { held_changed(Span<const PairKey>(&key, 1)); }
  void held_changed(Span<const PairKey> keys) noexcept;

  /// What bounds the memory: fences of boxes that are long, thin and close together can all overlap where no boxes do.
  /// A candidate takes 8 bytes.
  static constexpr std::size_t most_candidates(std::size_t ranks, std::size_t pairs) { return 8 * ranks + 4 * pairs; }

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
  /// Key and, in the lowest bit, whether the pair is held.
  using Candidate = std::uint64_t;
  static PairKey key_of(Candidate candidate) { return candidate >> 1; }
  static bool is_held(Candidate candidate) { return (candidate & 1) != 0; }

  /// Skins for so many updates, and what each of these and of renewals will cost on average.
  struct Plan {
    unsigned updates;
    double price;
  };

  /// So many look at all fences rather than have an index made.
  static constexpr std::size_t most_scanning = 64;

  /// What a search works with.
  struct Task {
    const ProxyTable<S>& proxies;
    const PairLists& held;
    bool sticky_filters;
    std::size_t most;  // candidates
    std::vector<Pair>& begun;
    std::vector<Pair>& ended;

    /// True if a held pair is to be held on.
    bool stays(PairKey key) const;
    /// True if a pair that has come to overlap is to be held.
    bool may_begin(Pair pair) const;
  };

  void grow_to(std::size_t ranks);
  const Box* cores(std::size_t rank) const { return has_cores_ ? &cores_[rank] : nullptr; }
  std::size_t kept() const { return candidates_.size() + sure_.size(); }
  void drift(std::size_t touched) noexcept;
  S drift_on(int axis) const { return drift_[axis + 1]; }
  const S* drift() const { return drifts_ ? drift_ + 1 : nullptr; }
  bool contains(std::uint32_t rank, const Box& box) const;
  void notice(const ProxyTable<S>& proxies, std::uint32_t rank) noexcept;
  void notice_all(const ProxyTable<S>& proxies) noexcept;
  template <class Skin>
  void raise(std::uint32_t rank, const Box& box, Skin&& skin);
  void raise_again(std::uint32_t rank, const Box& box);
  void raise_all(const ProxyTable<S>& proxies, std::size_t pairs);
  std::size_t walk_price(std::size_t touched, std::size_t candidates) const;
  std::size_t escape_price() const;
  std::size_t renewal_price(std::size_t ranks, std::size_t pairs, std::size_t candidates) const;
  std::size_t candidates_after(unsigned updates, std::size_t pairs) const;
  std::size_t sure_after(unsigned updates, std::size_t pairs) const;
  bool fits_skins(unsigned updates) const;
  Plan best_plan(std::size_t touched, std::size_t ranks, std::size_t pairs) const;
  void correct_changed(const Task& task);
  bool renew_escaped(const Task& task);
  void drop_escaped(const Task& task, std::vector<Candidate>& candidates);
  bool scans() const { return !is_indexed_ && escaped_.size() <= most_scanning; }
  bool probe_escaped(const Task& task);
  bool scan(const Task& task, std::uint32_t rank);
  void add(const Task& task, std::uint32_t rank, std::uint32_t other);
  void pass(const Task& task);

  bool stand_ = false;
  std::uint32_t update_ = 0;
  Motion<S> motion_;
  unsigned planned_ = 1;  // skins are for so many updates
  Reach<S> skins_;

  // Since the last renewal.
  std::size_t spent_ = 0, spent_on_escapes_ = 0;
  std::size_t updates_ = 0;
  S drift_[5] = {};  // by axis, between two zeros
  bool drifts_ = false;

  // Of each rank.
  std::vector<Box> fences_;
  std::vector<Box> cores_;  // if has_cores_
  bool has_cores_ = false;
  std::vector<std::uint32_t> raised_;  // in which update; 0: never
  std::vector<std::uint8_t> has_escaped_;

  Bvh<S> index_;  // of the fences, by rank
  bool is_indexed_ = false;

  std::vector<std::uint32_t> escaped_;
  std::vector<Candidate> candidates_;  // each once, in the order in which they were found
  std::vector<Candidate> sure_;        // others, held
  std::vector<PairKey> changed_;       // held or not, other than the candidate says

  // Scratch.
  std::vector<std::uint32_t> asking_;
  std::vector<Box> asking_fences_;
  BatchWalk<S> walk_;
};

}  // namespace boxstream::detail
