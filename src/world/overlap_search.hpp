// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <boxstream/detector.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/stats.hpp>
#include <boxstream/world.hpp>

#include "world/fat_boxes/lazy_fat_boxes.hpp"
#include "world/index.hpp"
#include "world/search_choice.hpp"
#include "world/state/proxies.hpp"
#include "world/state/update_threads.hpp"

namespace boxstream::detail {

/// Takes pairs of ranks, the smaller one first.
using RankPairSink = FunctionRef<void(Span<const Pair>)>;

/// Finds the overlapping pairs that group and mask accept: all of them, or those with a dirty proxy.
template <class S>
class OverlapSearch {
 public:
  explicit OverlapSearch(const WorldOptions& options)
      : executor_(options.executor),
        threads_(options.executor),
        detector_options_{options.executor, options.method, options.cutoff} {}

  /// Comes first in each update that does more than compare rows of bits. Motion is only looked at if candidates are
  /// kept, or may be.
  void begin_update(const ProxyTable<S>& proxies, bool with_candidates) {
    threads_.begin_update(proxies.ranks());
    if (with_candidates) fat_boxes_.make().begin_update(proxies, threads_);
  }

  /// The threads of this update.
  const UpdateThreads& threads() const { return threads_; }

  /// `none` or the cheapest of the others. `pairs` is how many are held.
  SearchMode choose(const ProxyTable<S>& proxies, const LazyIndex<S>& index, std::size_t pairs, bool is_few);
  SearchChoice& choice() { return choice_; }

  /// `sink` gets each pair once, in an order that depends on the mode.
  Stats run(SearchMode mode, const ProxyTable<S>& proxies, const LazyIndex<S>& index, RankPairSink sink);

  /// The mode `candidates`: `rebuild_candidates`, which is like `run`, if they have to be made anew; else
  /// `scan_candidates`, see FatBoxes::search. False if there are too many candidates: then run another mode.
  bool needs_rebuild(const ProxyTable<S>& proxies, std::size_t pairs) const {
    return choice_.is_rebuild(state(proxies, pairs));
  }
  bool rebuild_candidates(const ProxyTable<S>& proxies, std::size_t pairs, RankPairSink sink, Stats& stats);
  bool scan_candidates(const ProxyTable<S>& proxies, const PairLists& held, bool sticky_filters,
                       std::vector<Pair>& begun, std::vector<Pair>& ended);

  LazyFatBoxes<S>& fat_boxes() { return fat_boxes_; }

 private:
  Detector& detector() { return detector_ ? *detector_ : detector_.emplace(detector_options_); }

  /// What one task of a parallel search needs for itself.
  struct Part {
    BatchWalk<S> walk;
    std::vector<Pair> found;
  };

  SearchState state(const ProxyTable<S>& proxies, std::size_t pairs) const;
  void give_up_candidates();
  void note_dirty(const ProxyTable<S>& proxies);
  std::size_t keep_news(const ProxyTable<S>& proxies, std::uint32_t rank, std::uint32_t other, Pair* out) const;
  void run_probe(const ProxyTable<S>& proxies, const LazyIndex<S>& index, RankPairSink sink);
  Stats run_beside(const ProxyTable<S>& proxies, RankPairSink sink);
  void probe(const ProxyTable<S>& proxies, const Bvh<S>& bvh, std::size_t first, std::size_t count, Part& part,
             const RankPairSink* sink) const;

  Executor* executor_;
  UpdateThreads threads_;
  DetectorOptions detector_options_;
  std::optional<Detector> detector_;  // made when there is something for it to do
  LazyFatBoxes<S> fat_boxes_;
  SearchChoice choice_;
  std::vector<Part> parts_;
  std::vector<Pair> found_;           // by a search on several threads
  std::vector<std::uint32_t> ranks_;  // of the valid dirty boxes, and these
  std::vector<BasicAabb<S>> boxes_;
};

extern template class OverlapSearch<float>;
extern template class OverlapSearch<double>;

}  // namespace boxstream::detail
