// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <boxstream/span.hpp>

namespace boxstream::papers::volumes {

struct TreeNode {
  std::uint32_t parent = 0;  ///< of the root: itself
  std::uint32_t depth = 0;   ///< of the root: 0
  std::uint32_t first_child = 0, children = 0;
  std::uint32_t first_object = 0, objects = 0;  ///< in Tree::order: all that are beneath

  bool is_leaf() const { return children == 0; }
};

/// Definition 2 without its volumes: which objects are together. Of any arity and leaf size; no object is in two
/// leaves. nodes[0] is the root; parents come before children, and siblings are side by side. No objects: no nodes.
struct Tree {
  std::vector<TreeNode> nodes;
  std::vector<std::uint32_t> order;  ///< each object once

  Span<const std::uint32_t> objects(std::uint32_t node) const {
    return {order.data() + nodes[node].first_object, nodes[node].objects};
  }
};

/// A node of a tree that is being made: children, by their numbers in the draft, or objects.
struct DraftNode {
  std::vector<std::uint32_t> children;
  std::vector<std::uint32_t> objects;
};

/// Brings the nodes beneath `root` into the order that Tree has.
Tree laid_out(const std::vector<DraftNode>& draft, std::uint32_t root);

}  // namespace boxstream::papers::volumes
