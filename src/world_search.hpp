// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <boxstream/detector.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/stats.hpp>

#include "world_index.hpp"
#include "world_proxies.hpp"

namespace boxstream::detail {

/// How an update finds the pairs that may have begun. The outcome is the same for all.
enum class SearchMode {
  none,      ///< nothing was touched: no search
  probe,     ///< all touched proxies ask the index
  all,       ///< one batch, all against all
  cheapest,  ///< whichever of these costs least
};

/// Takes pairs of ranks, the smaller one first.
using RankPairSink = FunctionRef<void(Span<const Pair>)>;

/// Finds the overlapping pairs that group and mask accept: all of them, or those with a touched proxy.
template <class S>
class OverlapSearch {
 public:
  explicit OverlapSearch(DetectorOptions options) : detector_(options) {}

  /// `none` or the cheapest of the others.
  SearchMode choose(const ProxyTable<S>& proxies, const LazyIndex<S>& index);

  /// `sink` gets each pair once, in an order that depends on the mode.
  Stats run(SearchMode mode, const ProxyTable<S>& proxies, const LazyIndex<S>& index, RankPairSink sink);

 private:
  void run_probe(const ProxyTable<S>& proxies, const LazyIndex<S>& index, RankPairSink sink);

  Detector detector_;
  BatchWalk<S> walk_;
  std::size_t saved_ = 0;  // towards a refresh of the index, in the units of `choose`
  std::vector<Pair> found_;
  std::vector<std::uint32_t> ranks_;
  std::vector<BasicAabb<S>> boxes_;
};

extern template class OverlapSearch<float>;
extern template class OverlapSearch<double>;

}  // namespace boxstream::detail
