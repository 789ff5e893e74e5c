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
  const auto tell = [&](const NearOnes<S>& near) {
    for (const auto& one : near)
      if (now.is_above(one.distance)) now.set(visit(id_of_slot(bvh.slot_at(one.place)), one.distance));
  };
  const auto offer = [&](const NearOnes<S>& near) { environment.outside([&] { tell(near); }); };
  NearWalk<S, decltype(offer)>(bvh, now, offer).run(box);
}

template <class S>
void WorldCore<S>::nearest_pairs(const WorldCore& other, S limit, NearPairVisitor<S> visit) const {
  const InUse::Read read(in_use_);
  const InUse::Read read_other(other.in_use_);
  const Bvh<S>& bvh = index_.fresh(proxies_);
  const Bvh<S>& other_bvh = other.index_.fresh(other.proxies_);
  DefaultFloatEnvironment environment;
  NearLimit<S> now(limit);
  const auto tell = [&](const NearOnes<S>& near) {
    for (const auto& one : near) {
      std::uint32_t a = proxies_.rank_of_slot(bvh.slot_at(one.place));
      std::uint32_t b = other.proxies_.rank_of_slot(other_bvh.slot_at(one.other));
      if (!now.is_above(one.distance) || !accepts(proxies_.filter(a), other.proxies_.filter(b))) continue;
      if (this == &other && b < a) std::swap(a, b);
      now.set(visit({proxies_.id(a), other.proxies_.id(b)}, one.distance));
    }
  };
  const auto offer = [&](const NearOnes<S>& near) { environment.outside([&] { tell(near); }); };
  NearPairWalk<S, decltype(offer)>(bvh, other_bvh, now, offer).run();
}

#define INSTANTIATE(S)                                                                \
  template void WorldCore<S>::query_nearest_box(const Box&, S, NearVisitor<S>) const; \
  template void WorldCore<S>::nearest_pairs(const WorldCore&, S, NearPairVisitor<S>) const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
