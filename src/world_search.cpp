// SPDX-License-Identifier: MIT
#include "world_search.hpp"

#include <algorithm>

namespace boxstream::detail {

template <class S>
SearchMode OverlapSearch<S>::choose(const ProxyTable<S>& proxies, const LazyIndex<S>& index) {
  const std::size_t touched = proxies.touched().size();
  if (touched == 0) return SearchMode::none;
  // In units of one box in a batch of all, about 30 to 60 ns. A probe, and what it takes to keep the index fit for the
  // next one, costs 90 to 220 ns at 10^3 to 10^5 boxes with 0.5 to 2 pairs each.
  const std::size_t batch = proxies.ranks();
  const std::size_t probe = 4 * touched;
  if (probe >= batch) return SearchMode::all;
  // The index may have to take in the changes of many updates first, or to be built. That pays off only if few proxies
  // move in the next updates too. So the price is saved up from what probes would have gained so far, and at the worst
  // twice the cheaper way is spent.
  const std::size_t refresh = 2 * index.refresh_cost(touched);
  if (probe + refresh <= batch + saved_) {
    saved_ = 0;
    return SearchMode::probe;
  }
  saved_ += batch - probe;
  return SearchMode::all;
}

template <class S>
Stats OverlapSearch<S>::run(SearchMode mode, const ProxyTable<S>& proxies, const LazyIndex<S>& index,
                            RankPairSink sink) {
  switch (mode) {
    case SearchMode::probe:
      run_probe(proxies, index, sink);
      return {};
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
  const Span<const Filter> filters = proxies.batch_filters();
  ranks_.clear();
  boxes_.clear();
  for (const std::uint32_t rank : proxies.touched()) {
    if (!proxies.is_valid(rank)) continue;
    ranks_.push_back(rank);
    boxes_.push_back(proxies.box(rank));
  }
  const auto keep = [&](Span<const Pair> pairs) {
    found_.clear();
    for (const Pair p : pairs) {
      const std::uint32_t rank = ranks_[p.a];
      const std::uint32_t other = proxies.rank_of_slot(p.b);
      if (is_second_sight(proxies, rank, other)) continue;
      if (filters.empty() || accepts(filters[rank], filters[other])) found_.push_back(ordered(rank, other));
    }
    sink(found_);
  };
  index.fresh(proxies).find_overlaps(boxes_, walk_, keep);
}

template class OverlapSearch<float>;
template class OverlapSearch<double>;

}  // namespace boxstream::detail
