// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>

#include <boxstream/detail/float_environment.hpp>
#include <boxstream/detail/lazy_float_environment.hpp>

#include "base/bits.hpp"
#include "base/keys.hpp"
#include "base/thresholds.hpp"
#include "nearest/nearest_boxes.hpp"
#include "world/core.hpp"

namespace boxstream {

using namespace detail;

template <class S>
void BasicWorld<S>::query_box(const Box& box, ProxyVisitor visit) const {
  const InUse::Read read(impl_->in_use_);
  const BoxKeys<S> keys(box);
  if (!keys.are_valid()) return;
  const FewBoxes<S>& few = impl_->proxies_.few();
  if (few.is_kept()) {
    std::uint64_t bits[FewBoxes<S>::most_words];
    const std::size_t words = few.find_touching(keys, impl_->proxies_.ranks(), bits);
    for_each_index(bits, words, [&](std::uint32_t rank) { return visit(impl_->proxies_.id(rank)); });
    return;
  }
  const Bvh<S>& bvh = impl_->index_.fresh(impl_->proxies_);
  LazyFloatEnvironment environment;  // which comparisons leave without a flag
  bvh.for_each_overlap(box, [&](std::uint32_t slot) {
    const std::uint32_t rank = impl_->proxies_.rank_of_slot(slot);
    if (!overlap_by_keys(box, impl_->proxies_.box(rank))) return true;
    environment.go_out();
    if (!visit(impl_->proxies_.id(rank))) return false;
    environment.come_in();
    return true;
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

namespace {

/// False for a ray that is not for few boxes. Only what is computed needs the default environment: visitors are called
/// in the caller's, where lengths are compared by keys.
template <class S>
bool visit_hits_of_few(const ProxyTable<S>& proxies, const BasicRay<S>& ray, RayVisitor<S> visit) {
  std::uint64_t hits[FewBoxes<S>::most_words];
  S enter[FewBoxes<S>::most_lanes];
  std::optional<DefaultFloatEnvironment> environment(std::in_place);
  const RaySlabs<S> slabs(ray);
  if (slabs.hits_nothing) return true;
  if (slabs.is_long[0] || slabs.is_long[1] || slabs.is_long[2]) return false;
  const std::size_t words = proxies.few().find_hits(slabs, proxies.ranks(), enter, hits);
  S length = slabs.length;
  environment.reset();
  for_each_index(hits, words, [&](std::uint32_t rank) {
    if (order_key(enter[rank]) > order_key(length)) return true;  // clipped since
    const S clipped = visit(proxies.id(rank), enter[rank], length);
    const auto key = order_key(clipped);
    if (key < order_key(length)) length = clipped;
    return key >= 0 && key <= infinity_key<S>;  // false for NaN
  });
  return true;
}

}  // namespace

template <class S>
void BasicWorld<S>::query_ray(const BasicRay<S>& ray, RayVisitor<S> visit) const {
  const InUse::Read read(impl_->in_use_);
  if (impl_->scans_few() && visit_hits_of_few(impl_->proxies_, ray, visit)) return;
  const Bvh<S>& bvh = impl_->index_.fresh(impl_->proxies_);
  DefaultFloatEnvironment environment;
  const RaySlabs<S> slabs(ray);
  if (slabs.hits_nothing) return;
  bvh.for_each_hit(slabs, [&](std::uint32_t slot, S enter, S length) {
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
