// SPDX-License-Identifier: MIT
// Pairs one by one, between updates.
#include <algorithm>

#include "world/core.hpp"

namespace boxstream::detail {

template <class S>
void WorldCore<S>::for_each_pair(FunctionRef<bool(ProxyPair)> visit) const {
  const InUse::Read read(in_use_);
  pairs_.for_each([&](PairKey key) { return visit(named(key)); });
}

template <class S>
void WorldCore<S>::stream_pairs(ProxyPairSink sink) const {
  const InUse::Read read(in_use_);
  constexpr std::size_t batch = 256;
  ProxyPair pairs[batch];
  if (pairs_.is_folded()) {
    const Span<const std::uint32_t> firsts = pairs_.lists().firsts();
    const Span<const std::uint32_t> seconds = pairs_.lists().seconds();
    for (std::size_t first = 0; first < firsts.size(); first += batch) {
      const std::size_t count = std::min(batch, firsts.size() - first);
      for (std::size_t i = 0; i < count; ++i)
        pairs[i] = {proxies_.id(firsts[first + i]), proxies_.id(seconds[first + i])};
      if (!sink(Span<const ProxyPair>(pairs, count))) return;
    }
    return;
  }
  std::size_t count = 0;
  bool going_on = true;
  pairs_.for_each([&](PairKey key) {
    pairs[count++] = named(key);
    if (count < batch) return true;
    count = 0;
    return going_on = sink(Span<const ProxyPair>(pairs, batch));
  });
  if (going_on && count != 0) sink(Span<const ProxyPair>(pairs, count));
}

template <class S>
void WorldCore<S>::begin_pairs_of(ProxyId id, ProxyPairFilter accept, FunctionRef<void(ProxyPair)> begin,
                                  bool accept_alone) {
  const InUse::Change change(in_use_);
  const std::uint32_t rank = proxies_.rank(id);
  if (rank == Proxies::none || !proxies_.is_valid(rank)) return;
  const Filter filter = proxies_.filter(rank);
  found_.clear();
  const Bvh<S>& bvh = index_.fresh(proxies_);
  bvh.find_overlaps(Span<const Box>(&proxies_.box(rank), 1), walk_, [&](Span<const Pair> pairs) {
    for (const Pair pair : pairs) {
      const std::uint32_t other = proxies_.rank_of_slot(pair.b);
      const PairKey key = pair_key(rank, other);
      if (other != rank && (accept_alone || accepts(filter, proxies_.filter(other))) &&
          proxies_.touching(rank, other) && !pairs_.contains(key))
        found_.push_back(key);
    }
  });
  // The order in which the index finds them depends on when it was last refreshed.
  std::sort(found_.begin(), found_.end());
  for (const PairKey key : found_) {
    const ProxyPair pair = named(key);
    if (!accept(pair.a, pair.b)) continue;
    pairs_.add(key);
    search_.fences().held_changed(key);
    begin(pair);
  }
}

template <class S>
bool WorldCore<S>::release(ProxyId a, ProxyId b) {
  const InUse::Change change(in_use_);
  const std::uint32_t rank_a = proxies_.rank(a);
  const std::uint32_t rank_b = proxies_.rank(b);
  if (rank_a == Proxies::none || rank_b == Proxies::none || rank_a == rank_b) return false;
  const PairKey key = pair_key(rank_a, rank_b);
  if (!pairs_.release(key)) return false;
  search_.fences().held_changed(key);
  return true;
}

#define INSTANTIATE(S)                                                                                      \
  template void WorldCore<S>::for_each_pair(FunctionRef<bool(ProxyPair)>) const;                            \
  template void WorldCore<S>::stream_pairs(ProxyPairSink) const;                                            \
  template void WorldCore<S>::begin_pairs_of(ProxyId, ProxyPairFilter, FunctionRef<void(ProxyPair)>, bool); \
  template bool WorldCore<S>::release(ProxyId, ProxyId)
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
