// SPDX-License-Identifier: MIT
#include <algorithm>

#include <boxstream/detail/float_environment.hpp>

#include "base/thresholds.hpp"
#include "nearest/nearest_boxes.hpp"
#include "world/core.hpp"

namespace boxstream {

using namespace detail;

template <class S>
void BasicWorld<S>::query_box(const Box& box, ProxyVisitor visit) const {
  const InUse::Read read(impl_->in_use_);
  if (!has_valid_keys(box)) return;
  impl_->index_.fresh(impl_->proxies_).for_each_overlap(box, [&](std::uint32_t slot) {
    const std::uint32_t rank = impl_->proxies_.rank_of_slot(slot);
    return !overlap_by_keys(box, impl_->proxies_.box(rank)) || visit(impl_->proxies_.id(rank));
  });
}

template <class S>
void BasicWorld<S>::query_planes(Span<const BasicPlane<S>> planes, ProxyVisitor visit) const {
  const InUse::Read read(impl_->in_use_);
  const Bvh<S>& bvh = impl_->index_.fresh(impl_->proxies_);
  constexpr std::size_t few = thresholds.few_planes;
  PlaneTest on_stack[few];
  std::vector<PlaneTest> on_heap(planes.size() > few ? planes.size() : 0);
  PlaneTest* const tests = planes.size() > few ? on_heap.data() : on_stack;
  DefaultFloatEnvironment environment;
  std::transform(planes.begin(), planes.end(), tests, [](const BasicPlane<S>& plane) { return PlaneTest(plane); });
  bvh.for_each_not_behind(Span<const PlaneTest>(tests, planes.size()), [&](std::uint32_t slot) {
    return environment.outside([&] { return visit(impl_->id_of_slot(slot)); });
  });
}

template <class S>
void BasicWorld<S>::query_ray(const BasicRay<S>& ray, RayVisitor<S> visit) const {
  const InUse::Read read(impl_->in_use_);
  const Bvh<S>& bvh = impl_->index_.fresh(impl_->proxies_);
  DefaultFloatEnvironment environment;
  bvh.for_each_hit(RaySlabs<S>(ray), [&](std::uint32_t slot, S enter, S length) {
    return environment.outside([&] { return visit(impl_->id_of_slot(slot), enter, length); });
  });
}

template <class S>
std::size_t BasicWorld<S>::query_nearest(const S (&point)[3], Span<ProxyId> out) const {
  const InUse::Read read(impl_->in_use_);
  if (out.empty()) return 0;
  const Bvh<S>& bvh = impl_->index_.fresh(impl_->proxies_);
  const DefaultFloatEnvironment environment;
  const ProxyTable<S>& proxies = impl_->proxies_;
  return find_nearest_boxes(
      bvh, point, std::min(out.size(), proxies.live()),
      [&](std::uint32_t place) { return proxies.rank_of_slot(bvh.slot_at(place)); },
      [&](std::size_t i, std::uint32_t rank) { out[i] = proxies.id(rank); });
}

template <class S>
typename BasicWorld<S>::Box BasicWorld<S>::bounds() const {
  const InUse::Read read(impl_->in_use_);
  const Bvh<S>& bvh = impl_->index_.fresh(impl_->proxies_);
  const DefaultFloatEnvironment environment;
  return bvh.bounds();
}

#define INSTANTIATE(S)                                                                      \
  template void BasicWorld<S>::query_box(const Box&, ProxyVisitor) const;                   \
  template void BasicWorld<S>::query_planes(Span<const BasicPlane<S>>, ProxyVisitor) const; \
  template void BasicWorld<S>::query_ray(const BasicRay<S>&, RayVisitor<S>) const;          \
  template std::size_t BasicWorld<S>::query_nearest(const S(&)[3], Span<ProxyId>) const;    \
  template BasicWorld<S>::Box BasicWorld<S>::bounds() const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream
