// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>

#include <boxstream/detail/float_environment.hpp>

#include "base/empty_or_whole.hpp"
#include "base/keys.hpp"
#include "base/thresholds.hpp"
#include "box_index/impl.hpp"
#include "nearest/nearest_boxes.hpp"

namespace boxstream {

using namespace detail;

template <class S>
BasicBoxIndex<S>::BasicBoxIndex(Span<const Box> boxes) : impl_(std::make_unique<Impl>()) {
  if (boxes.size() >= UINT32_MAX) throw std::length_error("boxstream: more than 2^32 - 2 boxes in an index");
  impl_->size = boxes.size();
  impl_->bvh.build(boxes.size(), [&](std::uint32_t i) { return boxes[i]; });
}

template <class S>
BasicBoxIndex<S>::~BasicBoxIndex() = default;
template <class S>
BasicBoxIndex<S>::BasicBoxIndex(BasicBoxIndex&&) noexcept = default;
template <class S>
BasicBoxIndex<S>& BasicBoxIndex<S>::operator=(BasicBoxIndex&&) noexcept = default;

template <class S>
std::size_t BasicBoxIndex<S>::size() const {
  return impl_->size;
}

template <class S>
typename BasicBoxIndex<S>::Box BasicBoxIndex<S>::bounds() const {
  const DefaultFloatEnvironment environment;
  return impl_->bvh.bounds();
}

template <class S>
void BasicBoxIndex<S>::query_box(const Box& box, BoxVisitor visit) const {
  if (!has_valid_keys(box)) return;
  DefaultFloatEnvironment environment;
  impl_->bvh.for_each_overlap(box,
                              [&](std::uint32_t slot) { return environment.outside([&] { return visit(slot); }); });
}

template <class S>
void BasicBoxIndex<S>::query_boxes(Span<const Box> boxes, std::vector<Pair>& found) const {
  EmptyOrWhole output(found);
  const DefaultFloatEnvironment environment;
  BatchWalk<S> walk;
  Box valid[BatchWalk<S>::portion];
  std::uint32_t places[BatchWalk<S>::portion];
  std::size_t count = 0;
  const auto add = [&](Span<const Pair> pairs) {
    for (const Pair pair : pairs) found.push_back({places[pair.a], pair.b});
  };
  if (boxes.size() >= UINT32_MAX) throw std::length_error("boxstream: more than 2^32 - 2 boxes in a query");
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (has_valid_keys(boxes[i])) {
      valid[count] = boxes[i];
      places[count++] = static_cast<std::uint32_t>(i);
    }
    if (count != BatchWalk<S>::portion && i + 1 != boxes.size()) continue;
    impl_->bvh.find_overlaps(Span<const Box>(valid, count), walk, add);
    count = 0;
  }
  output.is_whole();
}

template <class S>
void BasicBoxIndex<S>::query_planes(Span<const BasicPlane<S>> planes, BoxVisitor visit) const {
  std::vector<PlaneTest> tests;
  tests.reserve(planes.size());
  DefaultFloatEnvironment environment;
  for (const BasicPlane<S>& plane : planes) tests.emplace_back(plane);
  impl_->bvh.for_each_not_behind(Span<const PlaneTest>(tests),
                                 [&](std::uint32_t slot) { return environment.outside([&] { return visit(slot); }); });
}

template <class S>
void BasicBoxIndex<S>::query_ray(const BasicRay<S>& ray, BoxRayVisitor<S> visit) const {
  DefaultFloatEnvironment environment;
  impl_->bvh.for_each_hit(RaySlabs<S>(ray), [&](std::uint32_t slot, S enter, S length) {
    return environment.outside([&] { return visit(slot, enter, length); });
  });
}

template <class S>
std::size_t BasicBoxIndex<S>::query_nearest(const S (&point)[3], Span<std::uint32_t> out) const {
  if (out.empty()) return 0;
  const DefaultFloatEnvironment environment;
  return find_nearest_boxes(
      impl_->bvh, point, std::min(out.size(), impl_->size),
      [&](std::uint32_t place) { return impl_->bvh.slot_at(place); },
      [&](std::size_t i, std::uint32_t slot) { out[i] = slot; });
}

template <class S>
void BasicBoxIndex<S>::query_nearest_box(const Box& box, S limit, NearBoxVisitor<S> visit) const {
  if (!has_valid_keys(box)) return;
  const Bvh<S>& bvh = impl_->bvh;
  DefaultFloatEnvironment environment;
  const auto offer = [&](NearLimit<S>& now, std::uint32_t, std::uint32_t place, S) {
    const S distance = distance_below(box, bvh.box_at(place));
    if (now.is_above(distance)) now.set(environment.outside([&] { return visit(bvh.slot_at(place), distance); }));
  };
  NearVisits<S, decltype((offer))> visits(limit, offer);
  visit_near(box, bvh, visits);
}

template class BasicBoxIndex<float>;
template class BasicBoxIndex<double>;

}  // namespace boxstream
