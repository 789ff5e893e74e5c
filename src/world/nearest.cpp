// SPDX-License-Identifier: MIT
// Boxes and pairs by increasing distance, in bands: all candidates from a floor to a cut are collected, sorted and
// visited, then those from that cut on. A band holds few at first, because the first visits mostly bring the limit
// down, and many later, so that there are few bands. Nothing depends on what was skipped before, so the limit may rise
// as well as fall.
#include <boxstream/detail/float_environment.hpp>

#include "world/core.hpp"
#include "world/nearest_pairs.hpp"

namespace boxstream::detail {

template <class S>
void WorldCore<S>::query_nearest_box(const Box& box, S limit, NearVisitor<S> visit) const {
  const InUse::Read read(in_use_);
  const Bvh<S>& bvh = index_.fresh(proxies_);
  DefaultFloatEnvironment environment;
  if (!has_valid_keys(box) || !(limit > 0)) return;
  const auto collect = [&](auto& band, auto&& offer) {
    walk_near_newcomers(bvh, box, band, offer);
    walk_near(bvh, box, band, offer);
  };
  const auto resolve = [&](std::size_t place) {
    return NearCandidate<S>{distance_below(box, box_at(bvh, place)), proxies_.rank_of_slot(bvh.slot_at(place)), 0};
  };
  const auto tell = [&](const NearCandidate<S>& near) {
    if (!(near.distance < limit)) return false;
    limit = environment.outside([&] { return visit(proxies_.id(near.a), near.distance); });
    return true;
  };

  S floor = 0;
  {
    NearFew<S, 4> few(limit);
    collect(few, [&](std::size_t place, S squared) {
      if (few.wants(squared)) few.add({squared, static_cast<std::uint32_t>(place), 0});
    });
    if (!few.visit_in_order([&](const auto& entry) { return resolve(entry.a); }, tell)) return;
    floor = few.cut();
  }
  if (!(floor < limit)) return;
  const typename NearScratchPool<S>::Loan loan(near_scratch_);
  NearBand<S>& band = (*loan).band;
  for (NearPlan<S> plan(proxies_.live()); floor < limit;) {
    // All may be at one distance.
    band.start(floor, plan.cut(floor, limit), plan.room(), proxies_.live());
    collect(band, [&](std::size_t place, S) {
      const NearCandidate<S> candidate = resolve(place);
      if (band.wants(candidate.distance)) band.add(candidate);
    });
    if (!band.visit_in_order(tell)) return;
    plan.learn(floor, band.cut(), band.size());
    floor = band.cut();
  }
}

template <class S>
void WorldCore<S>::nearest_pairs(const WorldCore& other, S limit, NearPairVisitor<S> visit) const {
  const InUse::Read read(in_use_);
  const InUse::Read read_other(other.in_use_);
  const Bvh<S>& bvh = index_.fresh(proxies_);
  const Bvh<S>& other_bvh = other.index_.fresh(other.proxies_);
  DefaultFloatEnvironment environment;
  if (!(limit > 0)) return;
  const auto visit_outside = [&](ProxyPair pair, S distance) {
    return environment.outside([&] { return visit(pair, distance); });
  };
  const typename NearScratchPool<S>::Loan loan(near_scratch_);
  NearPairs<S>(proxies_, other.proxies_, bvh, other_bvh, *loan).visit_below(limit, visit_outside);
}

#define INSTANTIATE(S)                                                                \
  template void WorldCore<S>::query_nearest_box(const Box&, S, NearVisitor<S>) const; \
  template void WorldCore<S>::nearest_pairs(const WorldCore&, S, NearPairVisitor<S>) const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
