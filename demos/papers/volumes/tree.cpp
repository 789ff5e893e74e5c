// SPDX-License-Identifier: MIT
#include "papers/volumes/tree.hpp"

#include <algorithm>

namespace boxstream::papers::volumes {

Tree laid_out(const std::vector<DraftNode>& draft, std::uint32_t root) {
  Tree tree;
  std::vector<std::uint32_t> drafted{root};
  tree.nodes.emplace_back();
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const DraftNode& node = draft[drafted[i]];
    tree.nodes[i].first_child = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes[i].children = static_cast<std::uint32_t>(node.children.size());
    tree.nodes[i].objects = static_cast<std::uint32_t>(node.objects.size());
    for (const std::uint32_t child : node.children) {
      drafted.push_back(child);
      tree.nodes.push_back({i, tree.nodes[i].depth + 1});
    }
  }
  for (std::size_t i = tree.nodes.size(); --i > 0;) tree.nodes[tree.nodes[i].parent].objects += tree.nodes[i].objects;

  tree.order.resize(tree.nodes[0].objects);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const TreeNode& node = tree.nodes[i];
    std::uint32_t next = node.first_object;
    for (std::uint32_t c = 0; c < node.children; ++c) {
      TreeNode& child = tree.nodes[node.first_child + c];
      child.first_object = next;
      next += child.objects;
    }
    const std::vector<std::uint32_t>& own = draft[drafted[i]].objects;
    std::copy(own.begin(), own.end(), tree.order.begin() + node.first_object);
  }
  return tree;
}

}  // namespace boxstream::papers::volumes
