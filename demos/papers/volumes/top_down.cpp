// SPDX-License-Identifier: MIT
#include "papers/volumes/top_down.hpp"

#include <numeric>

namespace boxstream::papers::volumes {

Tree build_top_down(const Atoms& atoms, std::size_t leaf_size, Split split) {
  Tree tree;
  if (atoms.boxes.empty()) return tree;
  tree.order.resize(atoms.boxes.size());
  std::iota(tree.order.begin(), tree.order.end(), 0u);
  tree.nodes.push_back({0, 0, 0, 0, 0, static_cast<std::uint32_t>(tree.order.size())});
  // Level by level: parts of all objects are as deep as the heuristics make them, which can be too deep for a
  // recursion.
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const std::uint32_t first = tree.nodes[i].first_object, count = tree.nodes[i].objects;
    if (count <= leaf_size) continue;
    const auto low = static_cast<std::uint32_t>(split(atoms, Span<std::uint32_t>(&tree.order[first], count)));
    const std::uint32_t depth = tree.nodes[i].depth + 1;
    tree.nodes[i].first_child = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes[i].children = 2;
    tree.nodes.push_back({i, depth, 0, 0, first, low});
    tree.nodes.push_back({i, depth, 0, 0, first + low, count - low});
  }
  return tree;
}

}  // namespace boxstream::papers::volumes
