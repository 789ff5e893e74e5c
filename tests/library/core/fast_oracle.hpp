// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "oracle.hpp"

/// A plain one-axis sweep for batches that are too big for brute force; itself checked against brute force.
namespace boxstream::tests {

/// Number of pairs of projections on `axis` that touch: what a sweep along it must look at.
template <class S>
std::uint64_t projected_pairs(const Boxes<S>& boxes, int axis) {
  std::vector<S> lo, hi;
  for (const auto& box : boxes) {
    if (!makes_sense(box)) continue;
    lo.push_back(box.min[axis]);
    hi.push_back(box.max[axis]);
  }
  std::sort(lo.begin(), lo.end());
  std::sort(hi.begin(), hi.end());
  std::uint64_t pairs = 0;
  std::size_t closed = 0;
  for (std::size_t i = 0; i < lo.size(); ++i) {
    while (closed < hi.size() && hi[closed] < lo[i]) ++closed;
    pairs += i - closed;
  }
  return pairs;
}

/// Pairs within one set, sorted.
template <class S>
Pairs sweep(const Boxes<S>& boxes) {
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (projected_pairs(boxes, d) < projected_pairs(boxes, axis)) axis = d;
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (makes_sense(boxes[i])) order.push_back(i);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t x, std::uint32_t y) { return boxes[x].min[axis] < boxes[y].min[axis]; });
  Boxes<S> sorted;
  for (const std::uint32_t i : order) sorted.push_back(boxes[i]);
  Pairs pairs;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].min[axis] <= sorted[i].max[axis]; ++j)
      if (touch(sorted[i], sorted[j])) pairs.push_back({std::min(order[i], order[j]), std::max(order[i], order[j])});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Pairs between two sets, sorted: a sweep over both together that drops pairs within a set.
template <class S>
Pairs sweep(const Boxes<S>& a, const Boxes<S>& b) {
  Boxes<S> all = a;
  all.insert(all.end(), b.begin(), b.end());
  const auto first_b = static_cast<std::uint32_t>(a.size());
  Pairs pairs;
  for (const Pair pair : sweep(all))
    if (pair.a < first_b && pair.b >= first_b) pairs.push_back({pair.a, pair.b - first_b});
  return pairs;
}

}  // namespace boxstream::tests
