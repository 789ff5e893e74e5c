// SPDX-License-Identifier: MIT
#include "swift_sweep.hpp"

#include <cmath>
#include <limits>

#include "fast_oracle.hpp"

namespace boxstream::tests {

namespace {

/// The sides of all boxes on one axis, in the order of the sweep. Doubles are rounded outwards: what does not meet here
/// does not meet.
struct Sides {
  std::vector<float> lo, hi;
};

template <class S>
float rounded(S side, float towards) {
  const auto nearest = static_cast<float>(side);
  return (towards < 0 ? S{nearest} > side : S{nearest} < side) ? std::nextafter(nearest, towards) : nearest;
}

template <class S>
int best_axis(const Boxes<S>& boxes) {
  std::uint64_t pairs[3];
  for (int d = 0; d < 3; ++d) pairs[d] = projected_pairs(boxes, d);
  return static_cast<int>(std::min_element(pairs, pairs + 3) - pairs);
}

template <class S>
std::vector<std::uint32_t> order_along(const Boxes<S>& boxes, int axis) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (makes_sense(boxes[i])) order.push_back(i);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t x, std::uint32_t y) { return boxes[x].min[axis] < boxes[y].min[axis]; });
  return order;
}

template <class S>
Sides sides(const Boxes<S>& boxes, const std::vector<std::uint32_t>& order, int axis) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  Sides all;
  for (const std::uint32_t i : order) {
    all.lo.push_back(rounded(boxes[i].min[axis], -inf));
    all.hi.push_back(rounded(boxes[i].max[axis], inf));
  }
  return all;
}

/// Says of `count` boxes from `first` on which ones box i meets on both axes; false if none.
bool match(const Sides& u, const Sides& v, std::size_t i, std::size_t first, std::size_t count, std::int32_t* hits) {
  const float *u0 = u.lo.data() + first, *u1 = u.hi.data() + first, *v0 = v.lo.data() + first,
              *v1 = v.hi.data() + first;
  const float au0 = u.lo[i], au1 = u.hi[i], av0 = v.lo[i], av1 = v.hi[i];
  std::int32_t any = 0;
  for (std::size_t k = 0; k < count; ++k) {
    hits[k] = (u0[k] <= au1) & (au0 <= u1[k]) & (v0[k] <= av1) & (av0 <= v1[k]);
    any |= hits[k];
  }
  return any != 0;
}

}  // namespace

template <class S>
Pairs swift_sweep(const Boxes<S>& boxes) {
  constexpr std::size_t block = 64;
  const int axis = best_axis(boxes);
  const std::vector<std::uint32_t> order = order_along(boxes, axis);
  std::vector<S> starts;
  for (const std::uint32_t i : order) starts.push_back(boxes[i].min[axis]);
  const Sides u = sides(boxes, order, (axis + 1) % 3), v = sides(boxes, order, (axis + 2) % 3);
  Pairs pairs;
  std::int32_t hits[block];
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto reach = std::upper_bound(starts.begin(), starts.end(), boxes[order[i]].max[axis]);
    const auto end = static_cast<std::size_t>(reach - starts.begin());
    for (std::size_t first = i + 1; first < end; first += block) {
      const std::size_t count = std::min(block, end - first);
      if (!match(u, v, i, first, count, hits)) continue;
      for (std::size_t k = 0; k < count; ++k)
        if (hits[k] != 0 && touch(boxes[order[i]], boxes[order[first + k]]))
          pairs.push_back({std::min(order[i], order[first + k]), std::max(order[i], order[first + k])});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template Pairs swift_sweep(const Boxes<float>&);
template Pairs swift_sweep(const Boxes<double>&);

}  // namespace boxstream::tests
