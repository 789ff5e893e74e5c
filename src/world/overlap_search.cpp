// SPDX-License-Identifier: MIT
#include "world/overlap_search.hpp"

#include <algorithm>

#include <boxstream/detail/float_environment.hpp>

#include "base/even_parts.hpp"
#include "base/thresholds.hpp"
#include "batch/parallel/thrown.hpp"

namespace boxstream::detail {

template <class S>
SearchState OverlapSearch<S>::state(const ProxyTable<S>& proxies, std::size_t pairs) const {
  SearchState state;
  state.boxes = proxies.ranks();
  state.dirty = proxies.dirty().size();
  state.pairs = pairs;
  state.threads = threads_.count();
  state.candidates = fat_boxes_.state();
  return state;
}

template <class S>
SearchMode OverlapSearch<S>::choose(const ProxyTable<S>& proxies, const LazyIndex<S>& index, std::size_t pairs,
                                    bool is_few) {
  if (proxies.dirty().empty()) return SearchMode::none;
  const DefaultFloatEnvironment environment;  // the same choice in every host
  SearchState now = state(proxies, pairs);
  now.is_few = is_few;
  now.has_index = !is_few && index.is_ready(now.dirty);
  now.index_is_worn = now.has_index && index.is_worn();
  if (!now.candidates.are_kept) now.planned = fat_boxes_.make().planned_price(proxies, pairs);
  const SearchChoice::Choice choice = choice_.choose(now);
  if (choice.gives_up) fat_boxes_.drop();
  constexpr std::uint64_t work = 2;  // of building, see Bvh::build_part, that a unit of price is
  const bool is_ready =
      choice.worth_of_index != 0 && index.build_part(proxies, work * choice.worth_of_index, now.dirty);
  return is_ready ? SearchMode::probe : choice.mode;
}

template <class S>
void OverlapSearch<S>::give_up_candidates() {
  fat_boxes_.drop();
  choice_.gives_up();
}

template <class S>
bool OverlapSearch<S>::rebuild_candidates(const ProxyTable<S>& proxies, std::size_t pairs, RankPairSink sink,
                                          Stats& stats) {
  choice_.rebuilds(state(proxies, pairs));
  if (fat_boxes_.make().rebuild(proxies, pairs, detector(), sink, stats)) return true;
  give_up_candidates();
  return false;
}

template <class S>
bool OverlapSearch<S>::scan_candidates(const ProxyTable<S>& proxies, const PairLists& held, bool sticky_filters,
                                       std::vector<Pair>& begun, std::vector<Pair>& ended) {
  choice_.passes(state(proxies, static_cast<std::size_t>(held.size())));
  if (fat_boxes_.make().search(proxies, held, sticky_filters, threads_, begun, ended)) return true;
  give_up_candidates();
  return false;
}

template <class S>
Stats OverlapSearch<S>::run(SearchMode mode, const ProxyTable<S>& proxies, const LazyIndex<S>& index,
                            RankPairSink sink) {
  if (mode == SearchMode::probe) run_probe(proxies, index, sink);
  if (mode == SearchMode::beside) return run_beside(proxies, sink);
  if (mode != SearchMode::all) return {};
  if (threads_.parts(proxies.ranks()) > 1) {  // a stream would pass all pairs through the calling thread
    const Stats stats = detector().find_pairs(proxies.boxes(), found_, proxies.batch_filters());
    sink(found_);
    return stats;
  }
  const auto pass_on = [&](Span<const Pair> pairs) {
    sink(pairs);
    return true;
  };
  return detector().stream_pairs(proxies.boxes(), pass_on, proxies.batch_filters());
}

// A probe finds a pair of two dirty proxies twice, and each proxy itself. Kept is the pair found by the older one.
template <class S>
static bool is_duplicate(const ProxyTable<S>& proxies, std::uint32_t dirty, std::uint32_t other) {
  return (other <= dirty) & proxies.is_dirty(other);
}

template <class S>
void OverlapSearch<S>::note_dirty(const ProxyTable<S>& proxies) {
  ranks_.clear();
  boxes_.clear();
  for (const std::uint32_t rank : proxies.dirty()) {
    if (!proxies.is_valid(rank)) continue;
    ranks_.push_back(rank);
    boxes_.push_back(proxies.box(rank));
  }
}

/// Writes a pair found, and returns 1 if it is to be kept.
template <class S>
std::size_t OverlapSearch<S>::keep_news(const ProxyTable<S>& proxies, std::uint32_t rank, std::uint32_t other,
                                        Pair* out) const {
  const Span<const Filter> filters = proxies.batch_filters();
  *out = {std::min(rank, other), std::max(rank, other)};
  return !is_duplicate(proxies, rank, other) && (filters.empty() || accepts(filters[rank], filters[other]));
}

/// No index is brought up to date, so that the cost of a few moves does not depend on what was before.
template <class S>
Stats OverlapSearch<S>::run_beside(const ProxyTable<S>& proxies, RankPairSink sink) {
  note_dirty(proxies);
  if (boxes_.empty()) return {};
  return detector().stream_pairs(boxes_, proxies.boxes(), [&](Span<const Pair> pairs) {
    found_.resize(pairs.size());
    std::size_t size = 0;
    for (const Pair p : pairs) size += keep_news(proxies, ranks_[p.a], p.b, &found_[size]);
    sink(Span<const Pair>(found_.data(), size));
    return true;
  });
}

template <class S>
void OverlapSearch<S>::run_probe(const ProxyTable<S>& proxies, const LazyIndex<S>& index, RankPairSink sink) {
  note_dirty(proxies);
  const Bvh<S>& bvh = index.fresh(proxies);
  const std::size_t count = boxes_.size();
  const std::size_t parts =
      executor_ == nullptr ? 1
                           : std::max<std::size_t>(
                                 std::min<std::size_t>(executor_->concurrency(), count / thresholds.probes_of_task), 1);
  if (parts_.size() < parts) parts_.resize(parts);
  if (parts <= 1) return probe(proxies, bvh, 0, count, parts_[0], &sink);

  boxstream::detail::run_parts(*executor_, parts, [&](std::size_t i) {
    Part& part = parts_[i];
    const std::size_t first = begin_of_part(count, i, parts);
    part.found.clear();
    probe(proxies, bvh, first, begin_of_part(count, i + 1, parts) - first, part, nullptr);
  });
  for (std::size_t i = 0; i < parts; ++i) sink(parts_[i].found);
}

/// Without a sink, what is found stays with the part.
template <class S>
void OverlapSearch<S>::probe(const ProxyTable<S>& proxies, const Bvh<S>& bvh, std::size_t first, std::size_t count,
                             Part& part, const RankPairSink* sink) const {
  DefaultFloatEnvironment environment;
  if (count <= thresholds.probed_alone && sink != nullptr) {
    part.found.clear();
    for (std::size_t i = 0; i < count; ++i)
      bvh.for_each_overlap(boxes_[first + i], [&](std::uint32_t slot) {
        Pair pair;
        if (keep_news(proxies, ranks_[first + i], proxies.rank_of_slot(slot), &pair)) part.found.push_back(pair);
        return true;
      });
    environment.outside([&] { (*sink)(part.found); });
    return;
  }
  const auto keep = [&](Span<const Pair> pairs) {
    std::size_t size = sink != nullptr ? 0 : part.found.size();
    part.found.resize(size + pairs.size());
    for (const Pair p : pairs)
      size += keep_news(proxies, ranks_[first + p.a], proxies.rank_of_slot(p.b), &part.found[size]);
    part.found.resize(size);
    if (sink != nullptr) environment.outside([&] { (*sink)(part.found); });  // it may ask a filter of the caller
  };
  bvh.find_overlaps(Span<const BasicAabb<S>>(boxes_.data() + first, count), part.walk, keep);
}

template class OverlapSearch<float>;
template class OverlapSearch<double>;

}  // namespace boxstream::detail
