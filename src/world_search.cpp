// SPDX-License-Identifier: MIT
#include "world_search.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace boxstream::detail {

namespace {

// A tenth of a millisecond of probes: handing out less costs more than it saves.
constexpr std::size_t least_boxes_of_a_part = 1024;

/// True if comparisons take denormal numbers for zero. The index, which compares numbers, then finds what it should and
/// may find more.
template <class S>
bool denormals_are_zero() {
  const volatile S smallest = std::numeric_limits<S>::denorm_min();
  return !(smallest > 0);
}

}  // namespace

template <class S>
SearchMode OverlapSearch<S>::choose(const ProxyTable<S>& proxies, const LazyIndex<S>& index) {
  const std::size_t touched = proxies.touched().size();
  if (touched == 0) return SearchMode::none;
  // In units of one box in a batch of all, which is 30 to 60 ns. A probe, and what it takes to keep the index fit for
  // the next one, costs 60, 90, 120 and 170 ns at 10^2, 10^3, 10^4 and 10^5 boxes: it grows as the tree is deep.
  const std::size_t batch = proxies.ranks();
  const std::size_t probe = touched * static_cast<std::size_t>(std::bit_width(batch)) / 5;
  if (probe >= batch) return SearchMode::all;
  // The index may have to take in the changes of many updates first, or to be built. That pays off only if few proxies
  // move in the next updates too. So the price is saved up from what probes would have gained so far, and at the worst
  // twice the cheaper way is spent.
  const std::size_t refresh = 3 * index.refresh_cost(touched);
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
  return (other <= touched) & proxies.is_touched(other);
}

template <class S>
void OverlapSearch<S>::run_probe(const ProxyTable<S>& proxies, const LazyIndex<S>& index, RankPairSink sink) {
  ranks_.clear();
  boxes_.clear();
  for (const std::uint32_t rank : proxies.touched()) {
    if (!proxies.is_valid(rank)) continue;
    ranks_.push_back(rank);
    boxes_.push_back(proxies.box(rank));
  }
  const Bvh<S>& bvh = index.fresh(proxies);
  const std::size_t count = boxes_.size();
  const std::size_t parts =
      executor_ == nullptr ? 1 : std::min<std::size_t>(executor_->concurrency(), count / least_boxes_of_a_part);
  if (parts <= 1) return probe(proxies, bvh, 0, count, parts_[0], &sink);

  if (parts_.size() < parts) parts_.resize(parts);
  executor_->parallel_for(parts, [&](std::size_t i) {
    Part& part = parts_[i];
    part.error = nullptr;
    const std::size_t first = count * i / parts;
    try {
      part.found.clear();
      probe(proxies, bvh, first, count * (i + 1) / parts - first, part, nullptr);
    } catch (...) {
      part.error = std::current_exception();
    }
  });
  for (std::size_t i = 0; i < parts; ++i)
    if (parts_[i].error) std::rethrow_exception(parts_[i].error);
  for (std::size_t i = 0; i < parts; ++i) sink(parts_[i].found);
}

/// Without a sink, what is found stays with the part.
template <class S>
void OverlapSearch<S>::probe(const ProxyTable<S>& proxies, const Bvh<S>& bvh, std::size_t first, std::size_t count,
                             Part& part, const RankPairSink* sink) const {
  const Span<const Filter> filters = proxies.batch_filters();
  const bool look_again = denormals_are_zero<S>();
  const auto keep = [&](Span<const Pair> pairs) {
    std::size_t size = sink != nullptr ? 0 : part.found.size();
    part.found.resize(size + pairs.size());
    for (const Pair p : pairs) {
      const std::uint32_t rank = ranks_[first + p.a];
      const std::uint32_t other = proxies.rank_of_slot(p.b);
      part.found[size] = {std::min(rank, other), std::max(rank, other)};
      size += !is_second_sight(proxies, rank, other) && (filters.empty() || accepts(filters[rank], filters[other])) &&
              (!look_again || proxies.touching(rank, other));
    }
    part.found.resize(size);
    if (sink != nullptr) (*sink)(part.found);
  };
  bvh.find_overlaps(Span<const BasicAabb<S>>(boxes_.data() + first, count), part.walk, keep);
}

template class OverlapSearch<float>;
template class OverlapSearch<double>;

}  // namespace boxstream::detail
