// SPDX-License-Identifier: MIT
#include "world_search.hpp"

#include <algorithm>

namespace boxstream::detail {

template <class S>
SearchMode OverlapSearch<S>::choose(const ProxyTable<S>& proxies, const LazyIndex<S>& index) {
  const std::size_t touched = proxies.touched().size();
  if (touched == 0) return SearchMode::none;
  // In units of one box in a batch of all, measured at 10^5 boxes with 0.5 to 13 pairs each: a batch against all reads
  // every box, which costs a quarter of that, and 3 for each touched one; a probe costs 8.
  const std::size_t all = proxies.ranks();
  const std::size_t batch = std::min(all, all / 4 + 3 * touched);
  const std::size_t probe = 8 * touched;
  // The index may have to take in the changes of many updates first, or to be built, which costs about 3 a box at the
  // worst. That pays off only if few proxies move in the next updates too. So the price is saved up from what probes
  // would have gained so far, and at the worst twice the cheaper way is spent.
  const std::size_t refresh = 3 * index.refresh_cost();
  if (probe < batch) {
    if (probe + refresh <= batch + saved_) {
      saved_ = 0;
      return SearchMode::probe;
    }
    saved_ += batch - probe;
  }
  return batch < all ? SearchMode::touched : SearchMode::all;
}

template <class S>
Stats OverlapSearch<S>::run(SearchMode mode, const ProxyTable<S>& proxies, const LazyIndex<S>& index,
                            RankPairSink sink) {
  switch (mode) {
    case SearchMode::probe:
      run_probe(proxies, index, sink);
      return {};
    case SearchMode::touched:
      return run_touched(proxies, sink);
    case SearchMode::all: {
      const auto pass_on = [&](Span<const Pair> pairs) {
        sink(pairs);
        return true;
      };
      return detector_.stream_pairs(proxies.boxes(), pass_on, proxies.batch_filters());
    }
    case SearchMode::none:
    case SearchMode::cheapest:
      break;
  }
  return {};
}

// A pair of two touched proxies turns up from both sides, and each proxy meets itself. The side of the older one
// counts.
template <class S>
static bool is_second_sight(const ProxyTable<S>& proxies, std::uint32_t touched, std::uint32_t other) {
  return other <= touched && proxies.is_touched(other);
}

static Pair ordered(std::uint32_t a, std::uint32_t b) {
  return a < b ? Pair{a, b} : Pair{b, a};
}

template <class S>
void OverlapSearch<S>::run_probe(const ProxyTable<S>& proxies, const LazyIndex<S>& index, RankPairSink sink) {
  const Bvh<S>& bvh = index.fresh(proxies);
  found_.clear();
  for (const std::uint32_t rank : proxies.touched()) {
    if (!proxies.is_valid(rank)) continue;
    const Filter filter = proxies.filter(rank);
    bvh.for_each_overlap(proxies.box(rank), [&](std::uint32_t slot) {
      const std::uint32_t other = proxies.rank_of_slot(slot);
      if (!is_second_sight(proxies, rank, other) && accepts(filter, proxies.filter(other)))
        found_.push_back(ordered(rank, other));
      return true;
    });
  }
  sink(found_);
}

template <class S>
Stats OverlapSearch<S>::run_touched(const ProxyTable<S>& proxies, RankPairSink sink) {
  ranks_ = proxies.touched();
  std::sort(ranks_.begin(), ranks_.end());  // for the reading of boxes, and so that Stats do not depend on history
  const Span<const Filter> all_filters = proxies.batch_filters();
  boxes_.clear();
  filters_.clear();
  for (const std::uint32_t rank : ranks_) {
    boxes_.push_back(proxies.box(rank));
    if (!all_filters.empty()) filters_.push_back(all_filters[rank]);
  }
  const auto keep = [&](Span<const Pair> pairs) {
    found_.clear();
    for (const Pair p : pairs)
      if (!is_second_sight(proxies, ranks_[p.a], p.b)) found_.push_back(ordered(ranks_[p.a], p.b));
    sink(found_);
    return true;
  };
  return detector_.stream_pairs(Span<const BasicAabb<S>>(boxes_), proxies.boxes(), keep, filters_, all_filters);
}

template class OverlapSearch<float>;
template class OverlapSearch<double>;

}  // namespace boxstream::detail
