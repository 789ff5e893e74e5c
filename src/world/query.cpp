// SPDX-License-Identifier: MIT
#include <algorithm>

#include "world/core.hpp"

namespace boxstream::detail {

namespace {

/// A candidate for the nearest ones. Ranks break ties, so the order is total.
struct Near {
  double squared;
  std::uint32_t rank;

  friend bool operator<(const Near& x, const Near& y) {
    return x.squared != y.squared ? x.squared < y.squared : x.rank < y.rank;
  }
};

}  // namespace

template <class S>
void WorldCore<S>::query_box(const Box& box, ProxyVisitor visit) const {
  const InUse::Read read(in_use_);
  if (!has_valid_keys(box)) return;
  index_.fresh(proxies_).for_each_overlap(box, [&](std::uint32_t slot) {
    const std::uint32_t rank = proxies_.rank_of_slot(slot);
    return !overlap_by_keys(box, proxies_.box(rank)) || visit(proxies_.id(rank));
  });
}

template <class S>
void WorldCore<S>::query_planes(Span<const BasicPlane<S>> planes, ProxyVisitor visit) const {
  const InUse::Read read(in_use_);
  constexpr std::size_t few = 16;
  PlaneTest on_stack[few];
  std::vector<PlaneTest> on_heap(planes.size() > few ? planes.size() : 0);
  PlaneTest* const tests = planes.size() > few ? on_heap.data() : on_stack;
  std::transform(planes.begin(), planes.end(), tests, [](const BasicPlane<S>& plane) { return PlaneTest(plane); });
  index_.fresh(proxies_).for_each_not_behind(Span<const PlaneTest>(tests, planes.size()),
                                             [&](std::uint32_t slot) { return visit(id_of_slot(slot)); });
}

template <class S>
void WorldCore<S>::query_ray(const BasicRay<S>& ray, RayVisitor<S> visit) const {
  const InUse::Read read(in_use_);
  index_.fresh(proxies_).for_each_hit(
      RaySlabs<S>(ray), [&](std::uint32_t slot, S enter, S length) { return visit(id_of_slot(slot), enter, length); });
}

template <class S>
std::size_t WorldCore<S>::query_nearest(const S (&point)[3], Span<ProxyId> out) const {
  const InUse::Read read(in_use_);
  if (out.empty()) return 0;
  const Bvh<S>& bvh = index_.fresh(proxies_);
  // The best so far as a heap, worst on top.
  const std::size_t wanted = std::min(out.size(), proxies_.live());
  constexpr std::size_t few = 32;
  Near on_stack[few];
  std::vector<Near> on_heap(wanted > few ? wanted : 0);
  Near* const best = wanted > few ? on_heap.data() : on_stack;
  std::size_t found = 0;
  bvh.for_each_near(point, [&](std::uint32_t slot, double squared) {
    const Near candidate{squared, proxies_.rank_of_slot(slot)};
    if (found < wanted) {
      best[found++] = candidate;
      std::push_heap(best, best + found);
    } else if (candidate < best[0]) {
      std::pop_heap(best, best + found);
      best[found - 1] = candidate;
      std::push_heap(best, best + found);
    }
    return found < wanted ? std::numeric_limits<double>::infinity() : best[0].squared;
  });
  std::sort_heap(best, best + found);
  for (std::size_t i = 0; i < found; ++i) out[i] = proxies_.id(best[i].rank);
  return found;
}

template <class S>
typename WorldCore<S>::Box WorldCore<S>::bounds() const {
  const InUse::Read read(in_use_);
  return index_.fresh(proxies_).bounds();
}

#define INSTANTIATE(S)                                                                     \
  template void WorldCore<S>::query_box(const Box&, ProxyVisitor) const;                   \
  template void WorldCore<S>::query_planes(Span<const BasicPlane<S>>, ProxyVisitor) const; \
  template void WorldCore<S>::query_ray(const BasicRay<S>&, RayVisitor<S>) const;          \
  template std::size_t WorldCore<S>::query_nearest(const S(&)[3], Span<ProxyId>) const;    \
  template WorldCore<S>::Box WorldCore<S>::bounds() const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
