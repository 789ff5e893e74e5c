// SPDX-License-Identifier: MIT
#include <algorithm>

#include <boxstream/detail/float_environment.hpp>

#include "base/thresholds.hpp"
#include "nearest/nearest_point.hpp"
#include "nearest/nearest_walk.hpp"
#include "world/core.hpp"

namespace boxstream {

using namespace detail;

namespace {

/// A candidate for the nearest ones.
struct Near {
  AboutSquared squared{0};
  std::uint32_t rank = 0;
};

}  // namespace

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

/// Where squares cannot tell. The order is total: ranks break ties.
template <class S>
bool WorldParts<S>::is_nearer(const S (&point)[3], std::uint32_t a, std::uint32_t b) const {
  const auto in_doubles = [this](std::uint32_t rank) -> Aabb64 {
    const Box& box = proxies_.box(rank);
    return {{box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2]}};
  };
  const int order = compare_distances({point[0], point[1], point[2]}, in_doubles(a), in_doubles(b));
  return order != 0 ? order < 0 : a < b;
}

template <class S>
std::size_t BasicWorld<S>::query_nearest(const S (&point)[3], Span<ProxyId> out) const {
  const InUse::Read read(impl_->in_use_);
  if (out.empty()) return 0;
  const Bvh<S>& bvh = impl_->index_.fresh(impl_->proxies_);
  const DefaultFloatEnvironment environment;
  const auto nearer = [&](const Near& x, const Near& y) {
    if (x.squared.is_clearly_below(y.squared)) return true;
    if (y.squared.is_clearly_below(x.squared)) return false;
    return impl_->is_nearer(point, x.rank, y.rank);
  };
  // The best so far as a heap, worst on top.
  const std::size_t wanted = std::min(out.size(), impl_->proxies_.live());
  constexpr std::size_t few = thresholds.few_nearest;
  Near on_stack[few];
  std::vector<Near> on_heap(wanted > few ? wanted : 0);
  Near* const best = wanted > few ? on_heap.data() : on_stack;
  std::size_t found = 0;
  const auto offer = [&](NearLimit<S>& limit, std::uint32_t, std::uint32_t place, S) {
    const AboutSquared squared(squared_distance(point, bvh.box_at(place)));
    if (found == wanted && best[0].squared.is_clearly_below(squared)) return;
    const Near candidate{squared, impl_->proxies_.rank_of_slot(bvh.slot_at(place))};
    if (found < wanted) {
      best[found++] = candidate;
      if (found == wanted) std::make_heap(best, best + found, nearer);
    } else if (nearer(candidate, best[0])) {
      std::pop_heap(best, best + found, nearer);
      best[found - 1] = candidate;
      std::push_heap(best, best + found, nearer);
    }
    if (found == wanted) limit.set(distance_above<S>(best[0].squared.reach()));
  };
  const Box at = {{point[0], point[1], point[2]}, {point[0], point[1], point[2]}};
  NearVisits<S, decltype((offer))> visits(std::numeric_limits<S>::infinity(), offer);
  if (wanted > 4) visits.expect_late_limit();
  visit_near(at, bvh, visits);
  if (found < wanted) std::make_heap(best, best + found, nearer);
  std::sort_heap(best, best + found, nearer);
  for (std::size_t i = 0; i < found; ++i) out[i] = impl_->proxies_.id(best[i].rank);
  return found;
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
