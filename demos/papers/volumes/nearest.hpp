// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "papers/volumes/hierarchy.hpp"

namespace boxstream::papers::volumes {

/// Distance from `p` to the nearest object beneath `node`, by `distance(object)`, the distance from `p` to one of them.
/// Nodes are entered nearest first, and not at all where the volume is farther off than what was found.
template <Volume V, class Distance>
double distance_to_nearest(const Hierarchy<V>& hierarchy, std::uint32_t node, const Point& p,
                           const Distance& distance) {
  struct Open {
    double excess;
    std::uint32_t node;
  };
  double best = std::numeric_limits<double>::infinity();
  std::vector<Open> open{{hierarchy.volume(node).excess(p), node}};
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    if (next.excess >= best) continue;
    const TreeNode& n = hierarchy.tree().nodes[next.node];
    if (n.is_leaf()) {
      for (const std::uint32_t object : hierarchy.tree().objects(next.node)) best = std::min(best, distance(object));
      continue;
    }
    const auto first = static_cast<std::ptrdiff_t>(open.size());
    for (std::uint32_t child = n.first_child; child < n.first_child + n.children; ++child)
      open.push_back({hierarchy.volume(child).excess(p), child});
    std::sort(open.begin() + first, open.end(), [](const Open& a, const Open& b) { return a.excess > b.excess; });
  }
  return best;
}

}  // namespace boxstream::papers::volumes
