// SPDX-License-Identifier: MIT
#include "world/overlap_search.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include <boxstream/detail/float_environment.hpp>

#include "base/even_parts.hpp"
#include "base/thresholds.hpp"
#include "batch/parallel/thrown.hpp"

namespace boxstream::detail {

/// Of comparing the dirty boxes with all, in units of a box in a batch of all. Where those are so few that nothing is
/// set up, a comparison takes two tenths of a nanosecond, and each box one to be read. More of them are searched as two
/// sets, of which the larger one is mostly culled.
static std::uint64_t price_of_beside(std::uint64_t boxes, std::uint64_t dirty) {
  const std::uint64_t as_sets = boxes / 5 + 7 * dirty;
  return dirty > thresholds.few ? as_sets : std::min(as_sets, boxes * (dirty + 5) / 125);
}

template <class S>
SearchMode OverlapSearch<S>::choose(const ProxyTable<S>& proxies, const LazyIndex<S>& index, std::size_t pairs) {
  const DefaultFloatEnvironment environment;  // the same choice in every host
  const std::size_t dirty = proxies.dirty().size();
  if (dirty == 0) return SearchMode::none;
  // In units of one box in a batch of all, which is 30 to 60 ns. A probe, and what it takes to keep the index fit for
  // the next one, costs 60, 90, 120 and 170 ns at 10^2, 10^3, 10^4 and 10^5 boxes: it grows as the tree is deep.
  const std::uint64_t batch = proxies.ranks();
  const std::uint64_t probe = dirty * static_cast<std::uint64_t>(std::bit_width(batch)) / 5;
  // Pairs cost half a unit each in these two modes, a quarter where a box takes long, and nothing with candidates. And
  // these two modes run on all threads.
  const std::size_t threads = threads_.count(), pairs_of_unit = batch < thresholds.in_near_caches ? 2 : 4;
  if (candidates_pay(
          proxies,
          std::min(probe / threads + std::uint64_t{pairs} * dirty / batch / 2, batch / threads + pairs / pairs_of_unit),
          pairs))
    return SearchMode::candidates;
  if (probe >= batch) return SearchMode::all;
  // Without an index that fits, a probe would have to build it. That pays only if few proxies move in the next updates
  // too. So each update builds as much of it as a probe would have saved: the total is at most twice that of the better
  // choice, and no update takes more than twice as long as those before it. Until then what has moved is compared with
  // all, if it is little.
  const std::uint64_t beside = price_of_beside(batch, dirty);
  const std::uint64_t instead = std::min(batch, beside);
  const bool pays = probe < instead;
  if (pays && (!index.needs_tree(dirty) || index.build_part(proxies, 2 * (instead - probe)))) return SearchMode::probe;
  return beside < batch ? SearchMode::beside : SearchMode::all;
}

/// Candidates are tried where they are expected to pay, and rebuilt if they have paid since the last rebuild.
template <class S>
bool OverlapSearch<S>::candidates_pay(const ProxyTable<S>& proxies, std::uint64_t otherwise, std::size_t pairs) {
  if (proxies.ranks() > FatBoxes<S>::most_ranks) return false;
  const std::uint64_t cost = fat_boxes_.cost(proxies, pairs);
  if (!fat_boxes_.is_active()) {
    if (wait_ > 0) {
      --wait_;
      return false;
    }
    if (cost + cost / 8 >= otherwise) return false;
    gained_by_candidates_ = 0;
    return true;
  }
  const std::int64_t gain = static_cast<std::int64_t>(otherwise) - static_cast<std::int64_t>(cost);
  if (fat_boxes_.needs_rebuild(proxies, pairs)) {
    if (gained_by_candidates_ + gain <= 0) {
      give_up_candidates();
      return false;
    }
    failures_ = 0;
    gained_by_candidates_ = 0;
    return true;
  }
  if (gain < 0 && 8 * proxies.dirty().size() < proxies.ranks()) return false;
  gained_by_candidates_ += gain;
  return true;
}

template <class S>
void OverlapSearch<S>::give_up_candidates() {
  fat_boxes_.drop();
  wait_ = thresholds.first_wait << 2 * failures_;
  failures_ = std::min(failures_ + 1, thresholds.most_failures);
}

template <class S>
bool OverlapSearch<S>::rebuild_candidates(const ProxyTable<S>& proxies, std::size_t pairs, RankPairSink sink,
                                          Stats& stats) {
  if (fat_boxes_.rebuild(proxies, pairs, detector(), sink, stats)) return true;
  give_up_candidates();
  return false;
}

template <class S>
bool OverlapSearch<S>::scan_candidates(const ProxyTable<S>& proxies, const PairLists& held, bool sticky_filters,
                                       std::vector<Pair>& begun, std::vector<Pair>& ended) {
  if (fat_boxes_.search(proxies, held, sticky_filters, threads_, begun, ended)) return true;
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
