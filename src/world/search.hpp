// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <exception>
#include <vector>

#include <boxstream/detector.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/stats.hpp>

#include "world/fences/fences.hpp"
#include "world/index.hpp"
#include "world/state/proxies.hpp"

namespace boxstream::detail {

/// How an update finds the pairs that may have begun. The outcome is the same for all.
enum class SearchMode {
  none,      ///< nothing was touched: no search
  probe,     ///< all touched proxies ask the index
  all,       ///< one batch, all against all
  fences,    ///< candidates kept from earlier updates
  cheapest,  ///< whichever of these costs least
};

/// Takes pairs of ranks, the smaller one first.
using RankPairSink = FunctionRef<void(Span<const Pair>)>;

/// Finds the overlapping pairs that group and mask accept: all of them, or those with a touched proxy.
template <class S>
class OverlapSearch {
 public:
  explicit OverlapSearch(Executor* executor) : executor_(executor), detector_({executor}), parts_(1) {}

  /// To be called once in each update that has touched proxies, before the rest.
  void notice(const ProxyTable<S>& proxies) { fences_.notice(proxies); }

  /// `none` or the cheapest of the others. `pairs` is how many are held.
  SearchMode choose(const ProxyTable<S>& proxies, const LazyIndex<S>& index, std::size_t pairs);

  /// `sink` gets each pair once, in an order that depends on the mode.
  Stats run(SearchMode mode, const ProxyTable<S>& proxies, const LazyIndex<S>& index, RankPairSink sink);

  /// The mode `fences`. If they are worn, `renew_fences`, which is like `run`; else see Fences::search. False if there
  /// are too many candidates: then this search is to be done in another mode.
  bool renew_fences(const ProxyTable<S>& proxies, std::size_t pairs, RankPairSink sink, Stats& stats);
  bool run_fences(const ProxyTable<S>& proxies, const PairLists& held, bool sticky_filters, std::vector<Pair>& begun,
                  std::vector<Pair>& ended);

  Fences<S>& fences() { return fences_; }
  const Fences<S>& fences() const { return fences_; }

 private:
  /// What one task of a parallel search needs for itself.
  struct Part {
    BatchWalk<S> walk;
    std::vector<Pair> found;
    std::exception_ptr error;
  };

  bool fences_pay(const ProxyTable<S>& proxies, std::size_t otherwise, std::size_t pairs);
  void give_up_fences();
  void run_probe(const ProxyTable<S>& proxies, const LazyIndex<S>& index, RankPairSink sink);
  void probe(const ProxyTable<S>& proxies, const Bvh<S>& bvh, std::size_t first, std::size_t count, Part& part,
             const RankPairSink* sink) const;

  Executor* executor_;
  Detector detector_;
  Fences<S> fences_;
  std::int64_t gained_by_fences_ = 0;  // since they were renewed, in the units of `choose`
  unsigned disappointed_ = 0;          // so often did fences pay less than they cost
  unsigned wait_ = 0;                  // for so many updates before they are tried again
  std::vector<Part> parts_;
  std::size_t saved_ = 0;             // towards a refresh of the index, in the units of `choose`
  std::vector<std::uint32_t> ranks_;  // of the boxes that ask, and these
  std::vector<BasicAabb<S>> boxes_;
};

extern template class OverlapSearch<float>;
extern template class OverlapSearch<double>;

}  // namespace boxstream::detail
