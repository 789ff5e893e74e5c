// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "papers/volumes/hierarchy.hpp"

namespace boxstream::papers::volumes {

/// All objects that meet something that `probe` encloses: nodes that are clear of the probe are not entered.
/// `meets(object)` compares the object itself; `found(object)` gets those for which it is true, each once.
template <Volume V, class Meets, class Found>
void query(const Hierarchy<V>& hierarchy, const V& probe, const Meets& meets, const Found& found, Counts& counts) {
  const Tree& tree = hierarchy.tree();
  std::vector<std::uint32_t> open;
  if (!tree.nodes.empty()) open.push_back(0);
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    ++counts.volume_tests;
    if (!overlap(hierarchy.volume(node), probe)) continue;
    const TreeNode& n = tree.nodes[node];
    for (std::uint32_t child = 0; child < n.children; ++child) open.push_back(n.first_child + child);
    if (!n.is_leaf()) continue;
    for (const std::uint32_t object : tree.objects(node)) {
      ++counts.primitive_tests;
      if (meets(object)) found(object);
    }
  }
}

}  // namespace boxstream::papers::volumes
