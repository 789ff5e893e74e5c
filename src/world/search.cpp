// SPDX-License-Identifier: MIT
#include "world/search.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include <boxstream/detail/float_environment.hpp>

namespace boxstream::detail {

namespace {

// A tenth of a millisecond of probes: handing out less costs more than it saves.
constexpr std::size_t least_boxes_of_a_part = 1024;

// After a disappointment, fences are not tried again for so many updates, after the next for four times as many.
constexpr unsigned first_wait = 16;
constexpr unsigned most_disappointed = 4;

}  // namespace

template <class S>
SearchMode OverlapSearch<S>::choose(const ProxyTable<S>& proxies, const LazyIndex<S>& index, std::size_t pairs) {
  const DefaultFloatEnvironment environment;  // the same choice in every host
  const std::size_t touched = proxies.touched().size();
  if (touched == 0) return SearchMode::none;
  // In units of one box in a batch of all, which is 30 to 60 ns. A probe, and what it takes to keep the index fit for
  // the next one, costs 60, 90, 120 and 170 ns at 10^2, 10^3, 10^4 and 10^5 boxes: it grows as the tree is deep.
  const std::size_t batch = proxies.ranks();
  const std::size_t probe = touched * static_cast<std::size_t>(std::bit_width(batch)) / 5;
  // What pairs cost, half a unit each, is the same for these two, but not for fences. And these two are shared out to
  // all threads.
  const std::size_t threads = executor_ == nullptr ? 1 : executor_->concurrency();
  if (fences_pay(proxies, std::min(probe / threads + pairs * touched / batch / 2, batch / threads + pairs / 2), pairs))
    return SearchMode::fences;
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

/// They are tried where boxes move so little that they should pay, and renewed if they have paid since they were.
template <class S>
bool OverlapSearch<S>::fences_pay(const ProxyTable<S>& proxies, std::size_t otherwise, std::size_t pairs) {
  if (proxies.ranks() > Fences<S>::most_ranks) return false;
  const std::size_t price = fences_.price(proxies, pairs);
  if (!fences_.stand()) {
    if (wait_ > 0) {
      --wait_;
      return false;
    }
    if (price + price / 8 >= otherwise) return false;
    gained_by_fences_ = 0;
    return true;
  }
  const std::int64_t gain = static_cast<std::int64_t>(otherwise) - static_cast<std::int64_t>(price);
  if (fences_.are_worn(proxies, pairs)) {
    if (gained_by_fences_ + gain <= 0) {
      give_up_fences();
      return false;
    }
    disappointed_ = 0;
    gained_by_fences_ = 0;
    return true;
  }
  if (gain < 0 && 8 * proxies.touched().size() < proxies.ranks()) return false;
  gained_by_fences_ += gain;
  return true;
}

template <class S>
void OverlapSearch<S>::give_up_fences() {
  fences_.drop();
  wait_ = first_wait << 2 * disappointed_;
  disappointed_ = std::min(disappointed_ + 1, most_disappointed);
}

template <class S>
bool OverlapSearch<S>::renew_fences(const ProxyTable<S>& proxies, std::size_t pairs, RankPairSink sink, Stats& stats) {
  if (fences_.renew(proxies, pairs, detector_, sink, stats)) return true;
  give_up_fences();
  return false;
}

template <class S>
bool OverlapSearch<S>::run_fences(const ProxyTable<S>& proxies, const PairLists& held, bool sticky_filters,
                                  std::vector<Pair>& begun, std::vector<Pair>& ended) {
  if (fences_.search(proxies, held, sticky_filters, begun, ended)) return true;
  give_up_fences();
  return false;
}

template <class S>
Stats OverlapSearch<S>::run(SearchMode mode, const ProxyTable<S>& proxies, const LazyIndex<S>& index,
                            RankPairSink sink) {
  if (mode == SearchMode::probe) run_probe(proxies, index, sink);
  if (mode != SearchMode::all) return {};
  const auto pass_on = [&](Span<const Pair> pairs) {
    sink(pairs);
    return true;
  };
  return detector_.stream_pairs(proxies.boxes(), pass_on, proxies.batch_filters());
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
  const DefaultFloatEnvironment environment;
  const auto keep = [&](Span<const Pair> pairs) {
    std::size_t size = sink != nullptr ? 0 : part.found.size();
    part.found.resize(size + pairs.size());
    for (const Pair p : pairs) {
      const std::uint32_t rank = ranks_[first + p.a];
      const std::uint32_t other = proxies.rank_of_slot(p.b);
      part.found[size] = {std::min(rank, other), std::max(rank, other)};
      size += !is_second_sight(proxies, rank, other) && (filters.empty() || accepts(filters[rank], filters[other]));
    }
    part.found.resize(size);
    if (sink != nullptr) (*sink)(part.found);
  };
  bvh.find_overlaps(Span<const BasicAabb<S>>(boxes_.data() + first, count), part.walk, keep);
}

template class OverlapSearch<float>;
template class OverlapSearch<double>;

}  // namespace boxstream::detail
