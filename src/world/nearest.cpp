// SPDX-License-Identifier: MIT
#include <cstdint>
#include <utility>

#include <boxstream/detail/float_environment.hpp>

#include "nearest/nearest_walk.hpp"
#include "world/core.hpp"

namespace boxstream {

using namespace detail;

template <class S>
void BasicWorld<S>::query_nearest_box(const Box& box, S limit, NearVisitor<S> visit) const {
  const InUse::Read read(impl_->in_use_);
  const Bvh<S>& bvh = impl_->index_.fresh(impl_->proxies_);
  DefaultFloatEnvironment environment;
  if (!has_valid_keys(box)) return;
  const auto offer = [&](NearLimit<S>& now, std::uint32_t, std::uint32_t place, S) {
    const S distance = distance_below(box, bvh.box_at(place));
    if (!now.is_above(distance)) return;
    const ProxyId id = impl_->id_of_slot(bvh.slot_at(place));
    now.set(environment.outside([&] { return visit(id, distance); }));
  };
  NearVisits<S, decltype((offer))> visits(limit, offer);
  visit_near(box, bvh, visits);
}

template <class S>
void BasicWorld<S>::nearest_pairs(const BasicWorld& other, S limit, NearPairVisitor<S> visit) const {
  const InUse::Read read(impl_->in_use_);
  const InUse::Read read_other(other.impl_->in_use_);
  const Bvh<S>& bvh = impl_->index_.fresh(impl_->proxies_);
  const Bvh<S>& other_bvh = other.impl_->index_.fresh(other.impl_->proxies_);
  DefaultFloatEnvironment environment;
  const auto offer = [&](NearLimit<S>& now, std::uint32_t place, std::uint32_t other_place, S) {
    const S distance = distance_below(bvh.box_at(place), other_bvh.box_at(other_place));
    if (!now.is_above(distance)) return;
    std::uint32_t a = impl_->proxies_.rank_of_slot(bvh.slot_at(place));
    std::uint32_t b = other.impl_->proxies_.rank_of_slot(other_bvh.slot_at(other_place));
    if (!accepts(impl_->proxies_.filter(a), other.impl_->proxies_.filter(b))) return;
    if (this == &other && b < a) std::swap(a, b);
    const ProxyPair pair{impl_->proxies_.id(a), other.impl_->proxies_.id(b)};
    now.set(environment.outside([&] { return visit(pair, distance); }));
  };
  NearVisits<S, decltype((offer))> visits(limit, offer);
  visit_near(NearSide<S>(bvh), NearSide<S>(other_bvh), visits);
}

template <class S>
void BasicWorld<S>::nearest_pairs(S limit, NearPairVisitor<S> visit) const {
  nearest_pairs(*this, limit, visit);
}

#define INSTANTIATE(S)                                                                 \
  template void BasicWorld<S>::nearest_pairs(S, NearPairVisitor<S>) const;             \
  template void BasicWorld<S>::query_nearest_box(const Box&, S, NearVisitor<S>) const; \
  template void BasicWorld<S>::nearest_pairs(const BasicWorld&, S, NearPairVisitor<S>) const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream
