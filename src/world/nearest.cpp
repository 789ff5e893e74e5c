// SPDX-License-Identifier: MIT
#include <cstdint>
#include <utility>

#include <boxstream/detail/float_environment.hpp>

#include "world/core.hpp"
#include "world/nearest_walk.hpp"

namespace boxstream::detail {

template <class S>
void WorldCore<S>::query_nearest_box(const Box& box, S limit, NearVisitor<S> visit) const {
  const InUse::Read read(in_use_);
  const Bvh<S>& bvh = index_.fresh(proxies_);
  DefaultFloatEnvironment environment;
  if (!has_valid_keys(box)) return;
  NearLimit<S> now(limit);
  const auto offer = [&](std::uint32_t, std::uint32_t place, S distance) {
    const ProxyId id = id_of_slot(bvh.slot_at(place));
    now.set(environment.outside([&] { return visit(id, distance); }));
  };
  NearWalk<S, decltype(offer)>(NearSide<S>(box), NearSide<S>(bvh), now, offer).run();
}

template <class S>
void WorldCore<S>::nearest_pairs(const WorldCore& other, S limit, NearPairVisitor<S> visit) const {
  const InUse::Read read(in_use_);
  const InUse::Read read_other(other.in_use_);
  const Bvh<S>& bvh = index_.fresh(proxies_);
  const Bvh<S>& other_bvh = other.index_.fresh(other.proxies_);
  DefaultFloatEnvironment environment;
  NearLimit<S> now(limit);
  const auto offer = [&](std::uint32_t place, std::uint32_t other_place, S distance) {
    std::uint32_t a = proxies_.rank_of_slot(bvh.slot_at(place));
    std::uint32_t b = other.proxies_.rank_of_slot(other_bvh.slot_at(other_place));
    if (!accepts(proxies_.filter(a), other.proxies_.filter(b))) return;
    if (this == &other && b < a) std::swap(a, b);
    const ProxyPair pair{proxies_.id(a), other.proxies_.id(b)};
    now.set(environment.outside([&] { return visit(pair, distance); }));
  };
  NearWalk<S, decltype(offer)>(NearSide<S>(bvh), NearSide<S>(other_bvh), now, offer).run();
}

#define INSTANTIATE(S)                                                                \
  template void WorldCore<S>::query_nearest_box(const Box&, S, NearVisitor<S>) const; \
  template void WorldCore<S>::nearest_pairs(const WorldCore&, S, NearPairVisitor<S>) const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
