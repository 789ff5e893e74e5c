// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/detector.hpp>
#include <boxstream/function_ref.hpp>

#include "base/thresholds.hpp"
#include "bvh/bvh.hpp"
#include "world/fat_boxes/motion_estimate.hpp"
#include "world/fat_boxes/selection.hpp"
#include "world/state/pairs.hpp"
#include "world/state/proxies.hpp"
#include "world/state/search_prices.hpp"
#include "world/state/update_threads.hpp"

namespace boxstream::detail {

/// Candidate pairs kept between updates, for worlds whose boxes move little at a time.
///
/// Each proxy has a fat box: its box when the fat box was fitted, larger by a margin on all sides. Pairs of overlapping
/// fat boxes are the candidates. While all boxes are inside their fat boxes, candidates contain all overlapping pairs.
/// - An update is one pass over the candidates with the exact comparison.
/// - For a box that has left its fat box (an exit), a new fat box is fitted and its candidates are found again.
/// - A rebuild fits all fat boxes and finds all candidates, by a batch.
/// Each candidate has a bit that says whether it is held as a pair, so that the pass shows what begins and what ends.
/// Results are those of a batch of all boxes: containment is tested exactly, and margins decide nothing else.
///
/// Each box has a core as well, smaller by the margin. A box that does not contain its core counts as an exit too.
/// Pairs whose cores overlap are sure: they overlap until one of the two exits, and the pass leaves them out. A core
/// may be inverted (min > max): the tests compare each bound by itself. Where boxes move so far that few pairs would be
/// sure, there are no cores.
///
/// All fat boxes may drift by one vector, so that a world that moves as a whole does not exit. Disjoint fat boxes stay
/// disjoint under drift, because rounded addition is monotone. While fat boxes drift, a box must be strictly inside:
/// a sum that compares less after rounding was less before it.
template <class S>
class FatBoxes {
 public:
  using Box = BasicAabb<S>;

  /// Finds the exits among the dirty ranks. To be called once in each update, before the rest.
  void begin_update(const ProxyTable<S>& proxies, const UpdateThreads& threads);

  /// What the price of an update with candidates depends on.
  CandidateState state() const {
    return {active_, fat_boxes_.size(), kept(), candidates_.size(), exited_.size(), is_indexed_};
  }
  /// Of an update, rebuilds included, if there were candidates: a huge number if motion is not known. `pairs` is the
  /// number of pairs of the last update.
  prices::Price planned_price(const ProxyTable<S>& proxies, std::size_t pairs) const;

  /// True while candidates are kept.
  bool is_active() const { return active_; }

  /// Refits all fat boxes and keeps their pairs as candidates. `sink` gets the pairs that overlap and that group and
  /// mask accept. These count as held and all others as not held; `held_changed` corrects that.
  ///
  /// False if there are more than `most_candidates`. Then call `drop`.
  bool rebuild(const ProxyTable<S>& proxies, std::size_t pairs, Detector& detector,
               FunctionRef<void(Span<const Pair>)> sink, Stats& stats);

  /// Compares held pairs with the pairs that overlap and that group and mask accept. `begun` gets those that are not
  /// held and have a dirty proxy, `ended` held pairs that end; both unsorted. With `sticky_filters`, held pairs end
  /// only when their boxes separate. From now on `begun` count as held and `ended` as not held; `held_changed` corrects
  /// that. Only while `is_active()`.
  ///
  /// False as for `rebuild`; ignore `begun` and `ended` then.
  bool search(const ProxyTable<S>& proxies, const PairLists& held, bool sticky_filters, const UpdateThreads& threads,
              std::vector<Pair>& begun, std::vector<Pair>& ended);

  /// A pair began or ended elsewhere. Drops all candidates if memory runs out.
  void held_changed(PairKey key) noexcept { held_changed(Span<const PairKey>(&key, 1)); }
  void held_changed(Span<const PairKey> keys) noexcept;

  /// Bounds the memory.
  static constexpr std::size_t most_candidates(std::size_t ranks, std::size_t pairs) {
    return thresholds.candidates_of_proxy * ranks + thresholds.candidates_of_pair * pairs;
  }

  /// With more proxies no candidates are kept.
  static constexpr std::size_t most_ranks = std::size_t{1} << 31;

  /// Drops all candidates, whatever state an exception has left them in; `is_active()` is false then. Needed after an
  /// exception in anything above.
  void drop() noexcept;

  /// Ranks changed, in order; dropped ones are `ProxyTable::none`.
  void remap(Span<const std::uint32_t> new_rank) noexcept;

  void clear() noexcept;

  /// Gives memory back that these candidates do not need.
  void give_back() noexcept {
    candidates_.shrink_to_fit();
    sure_.shrink_to_fit();
    changed_.shrink_to_fit();
  }

  /// Throws std::logic_error naming the first broken invariant. Needs `begin_update` after the last change.
  void validate(const ProxyTable<S>& proxies, const HeldPairs& held) const;

 private:
  /// Key and, in the lowest bit, whether the pair is held.
  using Candidate = std::uint64_t;
  static PairKey key_of(Candidate candidate) { return candidate >> 1; }
  static bool is_held(Candidate candidate) { return (candidate & 1) != 0; }

  /// Number of updates to make margins for, and the average cost of an update, rebuilds included.
  struct Plan {
    unsigned updates;
    prices::Price price;
  };

  /// The arguments of one search.
  struct Task {
    const ProxyTable<S>& proxies;
    const PairLists& held;
    bool sticky_filters;
    const UpdateThreads& threads;
    std::size_t most;  // candidates
    std::vector<Pair>& begun;
    std::vector<Pair>& ended;

    /// True if a held pair stays held.
    bool stays(PairKey key) const;
    /// True if a pair that begins to overlap may be held.
    bool may_begin(Pair pair) const;
  };

  void grow_to(std::size_t ranks);
  const Box* cores(std::size_t rank) const { return has_cores_ ? &cores_[rank] : nullptr; }
  std::size_t kept() const { return candidates_.size() + sure_.size(); }
  void drift(std::size_t dirty) noexcept;
  S drift_on(int axis) const { return drift_[axis + 1]; }
  const S* drift() const { return drifts_ ? drift_ + 1 : nullptr; }
  bool contains(std::uint32_t rank, const Box& box) const;
  void check_exit(const ProxyTable<S>& proxies, std::uint32_t rank) noexcept;
  void check_exits(const ProxyTable<S>& proxies, const UpdateThreads& threads);
  template <class Margin>
  void fit(std::uint32_t rank, const Box& box, Margin&& margin);
  void refit(std::uint32_t rank, const Box& box);
  void fit_all(const ProxyTable<S>& proxies, std::size_t pairs);
  std::uint64_t candidates_after(unsigned updates, std::size_t pairs) const;
  std::uint64_t sure_after(unsigned updates, std::size_t pairs) const;
  bool margins_fit(unsigned updates) const;
  Plan best_plan(std::size_t dirty, std::size_t ranks, std::size_t pairs) const;
  bool may_overlap(const ProxyTable<S>& proxies, std::uint32_t a, std::uint32_t b) const;
  void correct_changed(const Task& task);
  bool reinsert_exited(const Task& task);
  void forget_exits() noexcept;
  void drop_candidates_of_exited(const Task& task, std::vector<Candidate>& candidates);
  bool uses_scans() const { return exits_are_scanned(exited_.size(), is_indexed_); }
  bool find_candidates_of_exited(const Task& task);
  bool scan(const Task& task, std::uint32_t rank);
  void add(const Task& task, std::uint32_t rank, std::uint32_t other);
  void pass(const Task& task);

  bool active_ = false;
  std::uint32_t update_ = 0;
  MotionEstimate<S> motion_;
  unsigned planned_ = 1;  // updates that margins are made for
  Margins<S> margins_;

  // Since the last rebuild.
  S drift_[5] = {};  // by axis, between two zeros
  bool drifts_ = false;

  // Of each rank.
  std::vector<Box> fat_boxes_;
  std::vector<Box> cores_;  // if has_cores_
  bool has_cores_ = false;
  std::vector<std::uint32_t> fitted_in_;  // update of the last fit; 0: never
  std::vector<std::uint8_t> has_exited_;  // 1 for those in exited_

  Bvh<S> index_;  // of the fat boxes, by rank
  bool is_indexed_ = false;

  std::vector<std::uint32_t> exited_;
  std::vector<Candidate> candidates_;  // no duplicates, in the order of the search
  std::vector<Candidate> sure_;        // held pairs whose cores overlap; not in candidates_
  std::vector<PairKey> changed_;       // pairs whose held bit may be wrong

  // Scratch.
  Selection selection_;
  std::vector<std::uint32_t> queries_;
  std::vector<Box> query_boxes_;
  BatchWalk<S> walk_;
};

}  // namespace boxstream::detail
