// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/thresholds.hpp"
#include "nearest/nearest_point.hpp"
#include "nearest/nearest_walk.hpp"

namespace boxstream::detail {

/// The boxes of an index that are nearest to a point, by numbers of the caller's, which break ties: `number_of(place)`.
/// Calls `take(i, number)` for the first `wanted`, nearest first, and returns how many there are. Distances are
/// compared exactly. In the default floating-point environment.
template <class S, class NumberOf, class Take>
std::size_t find_nearest_boxes(const Bvh<S>& bvh, const S (&point)[3], std::size_t wanted, NumberOf&& number_of,
                               Take&& take) {
  struct Near {
    AboutSquared squared{0};
    std::uint32_t number = 0;
    std::uint32_t place = 0;
  };
  const auto nearer = [&](const Near& x, const Near& y) {
    if (x.squared.is_clearly_below(y.squared)) return true;
    if (y.squared.is_clearly_below(x.squared)) return false;
    const auto in_doubles = [&](std::uint32_t place) -> Aabb64 {
      const BasicAabb<S> box = bvh.box_at(place);
      return {{box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2]}};
    };
    const int order = compare_distances({point[0], point[1], point[2]}, in_doubles(x.place), in_doubles(y.place));
    return order != 0 ? order < 0 : x.number < y.number;
  };
  // The best so far as a heap, worst on top.
  constexpr std::size_t few = thresholds.few_nearest;
  Near on_stack[few];
  std::vector<Near> on_heap(wanted > few ? wanted : 0);
  Near* const best = wanted > few ? on_heap.data() : on_stack;
  std::size_t found = 0;
  const auto offer = [&](NearLimit<S>& limit, std::uint32_t, std::uint32_t place, S) {
    const AboutSquared squared(squared_distance(point, bvh.box_at(place)));
    if (found == wanted && best[0].squared.is_clearly_below(squared)) return;
    const Near candidate{squared, number_of(place), place};
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
  const BasicAabb<S> at = {{point[0], point[1], point[2]}, {point[0], point[1], point[2]}};
  NearVisits<S, decltype((offer))> visits(std::numeric_limits<S>::infinity(), offer);
  if (wanted > 4) visits.expect_late_limit();
  visit_near(at, bvh, visits);
  if (found < wanted) std::make_heap(best, best + found, nearer);
  std::sort_heap(best, best + found, nearer);
  for (std::size_t i = 0; i < found; ++i) take(i, best[i].number);
  return found;
}

}  // namespace boxstream::detail
