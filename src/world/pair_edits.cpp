// SPDX-License-Identifier: MIT
// Pairs between updates.
#include <algorithm>

#include <boxstream/detail/float_environment.hpp>

#include "base/thresholds.hpp"
#include "world/core.hpp"
#include "world/fat_boxes/fat_boxes_simd.hpp"

namespace boxstream {

using namespace detail;

template <class S>
std::uint64_t BasicWorld<S>::pair_count() const {
  return impl_->pairs_.size();
}

template <class S>
void BasicWorld<S>::for_each_pair(FunctionRef<bool(ProxyPair)> visit) const {
  const InUse::Read read(impl_->in_use_);
  impl_->pairs_.for_each([&](PairKey key) { return visit(impl_->named(key)); });
}

template <class S>
void BasicWorld<S>::stream_pairs(ProxyPairSink sink) const {
  const InUse::Read read(impl_->in_use_);
  constexpr std::size_t batch = thresholds.portion;
  ProxyPair pairs[batch];
  std::size_t count = 0;
  bool going_on = true;
  impl_->pairs_.for_each_run([&](const std::uint32_t* first, const std::uint32_t* second, std::size_t run) {
    for (std::size_t i = 0; going_on && i < run;) {
      const std::size_t some = std::min(batch - count, run - i);
      for (const std::size_t end = i + some; i < end; ++i)
        pairs[count++] = {impl_->proxies_.id(first[i]), impl_->proxies_.id(second[i])};
      if (count < batch) break;
      count = 0;
      going_on = sink(Span<const ProxyPair>(pairs, batch));
    }
    return going_on;
  });
  if (going_on && count != 0) sink(Span<const ProxyPair>(pairs, count));
}

/// Calls `visit(other)` for each proxy whose box touches that of `rank`, itself included. With few proxies a scan is
/// faster than a refresh of the index.
template <class S>
template <class Visit>
void WorldParts<S>::for_each_touching(std::uint32_t rank, Visit&& visit) {
  const Box& box = proxies_.box(rank);
  const auto check = [&](std::uint32_t other) {
    if (proxies_.touching(rank, other)) visit(other);
  };
  if (proxies_.ranks() <= thresholds.scanned_for_one) {
    std::uint32_t touching[thresholds.scanned_for_one];
    std::size_t count;
    {
      const DefaultFloatEnvironment environment;
      count = find_overlapping(proxies_.boxes().data(), proxies_.ranks(), box, touching);
    }
    std::for_each(touching, touching + count, check);
    return;
  }
  const Bvh<S>& index = index_.fresh(proxies_);
  DefaultFloatEnvironment environment;
  index.for_each_overlap(box, [&](std::uint32_t slot) {
    check(proxies_.rank_of_slot(slot));
    return true;
  });
}

template <class S>
void BasicWorld<S>::begin_pairs_of(ProxyId id, ProxyPairFilter accept, FunctionRef<void(ProxyPair)> begin,
                                   bool accept_alone, const Box& settled) {
  const InUse::Change change(impl_->in_use_);
  const std::uint32_t rank = impl_->proxies_.rank(id);
  if (rank == ProxyTable<S>::none || !impl_->proxies_.is_valid(rank)) return;
  const Filter filter = impl_->proxies_.filter(rank);
  const bool has_settled = has_valid_keys(settled);
  impl_->found_.clear();
  impl_->for_each_touching(rank, [&](std::uint32_t other) {
    if (other == rank || (has_settled && overlap_by_keys(settled, impl_->proxies_.box(other)))) return;
    const PairKey key = pair_key(rank, other);
    if ((accept_alone || accepts(filter, impl_->proxies_.filter(other))) && !impl_->pairs_.contains(key))
      impl_->found_.push_back(key);
  });
  // The order in which the index finds them depends on when it was last refreshed.
  std::sort(impl_->found_.begin(), impl_->found_.end());
  for (const PairKey key : impl_->found_) {
    const ProxyPair pair = impl_->named(key);
    if (!accept(pair.a, pair.b)) continue;
    impl_->pairs_.add(key);
    impl_->rooms_.forget();
    impl_->search_.fat_boxes().held_changed(key);
    begin(pair);
  }
}

template <class S>
void BasicWorld<S>::begin_pairs_of(ProxyId id, ProxyPairFilter accept, FunctionRef<void(ProxyPair)> begin,
                                   bool accept_alone) {
  begin_pairs_of(id, accept, begin, accept_alone, ProxyTable<S>::inert_box());
}

template <class S>
bool BasicWorld<S>::begin_told(ProxyId a, ProxyId b) {
  const InUse::Change change(impl_->in_use_);
  const std::uint32_t rank_a = impl_->proxies_.rank(a), rank_b = impl_->proxies_.rank(b);
  if (rank_a == ProxyTable<S>::none || rank_b == ProxyTable<S>::none || rank_a == rank_b) return false;
  const PairKey key = pair_key(rank_a, rank_b);
  if (impl_->pairs_.contains(key)) return false;
  impl_->pairs_.add(key);
  impl_->rooms_.forget();
  impl_->search_.fat_boxes().held_changed(key);
  return true;
}

template <class S>
bool BasicWorld<S>::room(ProxyId id, Box& outer, Box& inner) {
  const InUse::Change change(impl_->in_use_);
  const std::uint32_t rank = impl_->proxies_.rank(id);
  return rank != ProxyTable<S>::none && impl_->proxies_.dirty().empty() && impl_->rooms_.lend(rank, outer, inner);
}

template <class S>
std::optional<std::uint32_t> BasicWorld<S>::pair_place(ProxyId a, ProxyId b) const {
  const std::uint32_t rank_a = impl_->proxies_.rank(a), rank_b = impl_->proxies_.rank(b);
  if (rank_a == ProxyTable<S>::none || rank_b == ProxyTable<S>::none) return {};
  const PairKey key = pair_key(rank_a, rank_b);
  if (!impl_->pairs_.contains(key)) return {};
  return static_cast<std::uint32_t>(impl_->pairs_.place(key));
}

template <class S>
bool BasicWorld<S>::release(ProxyId a, ProxyId b) {
  const InUse::Change change(impl_->in_use_);
  const std::uint32_t rank_a = impl_->proxies_.rank(a);
  const std::uint32_t rank_b = impl_->proxies_.rank(b);
  if (rank_a == ProxyTable<S>::none || rank_b == ProxyTable<S>::none || rank_a == rank_b) return false;
  const PairKey key = pair_key(rank_a, rank_b);
  impl_->rooms_.forget();  // a refused one is asked about again
  if (!impl_->pairs_.release(key)) return false;
  impl_->search_.fat_boxes().held_changed(key);
  return true;
}

#define INSTANTIATE(S)                                                                                       \
  template std::uint64_t BasicWorld<S>::pair_count() const;                                                  \
  template void BasicWorld<S>::begin_pairs_of(ProxyId, ProxyPairFilter, FunctionRef<void(ProxyPair)>, bool); \
  template void BasicWorld<S>::for_each_pair(FunctionRef<bool(ProxyPair)>) const;                            \
  template void BasicWorld<S>::stream_pairs(ProxyPairSink) const;                                            \
  template void BasicWorld<S>::begin_pairs_of(ProxyId, ProxyPairFilter, FunctionRef<void(ProxyPair)>, bool,  \
                                              const Box&);                                                   \
  template bool BasicWorld<S>::begin_told(ProxyId, ProxyId);                                                 \
  template bool BasicWorld<S>::room(ProxyId, Box&, Box&);                                                    \
  template std::optional<std::uint32_t> BasicWorld<S>::pair_place(ProxyId, ProxyId) const;                   \
  template bool BasicWorld<S>::release(ProxyId, ProxyId)
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream
