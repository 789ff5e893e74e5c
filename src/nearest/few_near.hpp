// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/has_order.hpp"
#include "base/thresholds.hpp"
#include "nearest/nearest_walk.hpp"

namespace boxstream::detail {

/// The squared distance of two boxes, about: what `lanes_near` gives for lanes. In the default environment.
template <class S>
S about_squared(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  S sum = 0;
  for (int d = 0; d < 3; ++d) {
    const S below = a.min[d] - b.max[d], above = b.min[d] - a.max[d];
    // The second one if there is a NaN, from infinities that cancel.
    const S positive = above > 0 ? above : 0, gap = below > positive ? below : positive;
    sum += gap * gap;
  }
  return sum;
}

/// Pairs of very few boxes, compared one by one: less work than to put them into blocks.
template <class S>
class FewNear {
 public:
  static constexpr std::size_t most = thresholds.near_tests;

  /// The boxes at `a` and `b` of what is walked over, both valid.
  void add(std::uint32_t a, const BasicAabb<S>& box_a, std::uint32_t b, const BasicAabb<S>& box_b) {
    squared_[count_] = about_squared(box_a, box_b);
    places_[count_++] = {a, b};
  }

  /// The first pair for which `is(places, squared)`, or null.
  template <class Is>
  const NearPlaces* find(Is&& is) const {
    for (unsigned i = 0; i < count_; ++i)
      if (is(places_[i], squared_[i])) return &places_[i];
    return nullptr;
  }

  template <class Offer>
  void visit(NearVisits<S, Offer>& visits) const {
    visits.visit((std::uint64_t{1} << count_) - 1, squared_, [&](unsigned i) { return places_[i]; });
  }

 private:
  static_assert(most < 64);

  unsigned count_ = 0;
  S squared_[most];
  NearPlaces places_[most];
};

/// The boxes of `count` places at most as many as a block has lanes, `box_of(i)` as number i, that may be nearer to one
/// box than the limit.
template <class S, class BoxOf, class Offer>
void visit_near_few(const BasicAabb<S>& box, std::size_t count, BoxOf&& box_of, NearVisits<S, Offer>& visits) {
  using Lanes = NearLanes<S>;
  Lanes lanes;
  lanes.block = 0;
  visits.come_in();
  std::fill_n(lanes.keys, Lanes::width, Lanes::gone);
  for (unsigned i = 0; i < count; ++i)
    if (const BasicAabb<S>& mine = box_of(i); has_order(mine))
      lanes.keys[i] = Lanes::key_at(about_squared(mine, box), i);
  visits.visit(lanes);
}

}  // namespace boxstream::detail
