// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

namespace boxstream::bench {

/// Sorts along x, then compares each box with those that begin inside it: what one writes first. `order` is scratch.
template <class S>
void sorted_sweep(Span<const BasicAabb<S>> boxes, std::vector<std::uint32_t>& order, std::vector<Pair>& pairs) {
  pairs.clear();
  order.resize(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t j) { return boxes[i].min[0] < boxes[j].min[0]; });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].min[0] <= boxes[order[i]].max[0]; ++j)
      if (overlaps(boxes[order[i]], boxes[order[j]]))
        pairs.push_back({std::min(order[i], order[j]), std::max(order[i], order[j])});
}

}  // namespace boxstream::bench
