// SPDX-License-Identifier: MIT
#pragma once

#include "papers/volumes/tree.hpp"

namespace boxstream::papers::volumes {

/// A node of the recursion tree: a node of the one tree and a node of the other.
struct NodePair {
  std::uint32_t a, b;
  friend bool operator==(const NodePair&, const NodePair&) = default;
};

/// What comes beneath a pair. `both_sides` as printed: all children of the one with all children of the other.
/// `one_side`: the children of the shallower node, of equals a's, with the other node as it is; more levels, but fewer
/// pairs beneath each, so that a pair that is clear is seen as that earlier.
enum class Descent { both_sides, one_side };

/// The recursion tree of section 5.2, figure 50, which is not stored: children and parents follow from the two trees.
/// Both trees may be one and the same; pairs of nodes, and of objects, then come once, not in both orders.
class Recursion {
 public:
  Recursion(const Tree& a, const Tree& b, Descent descent) : a_(a), b_(b), descent_(descent) {}

  bool is_empty() const { return a_.nodes.empty() || b_.nodes.empty(); }
  static NodePair root() { return {0, 0}; }
  bool is_root(NodePair pair) const { return pair == root(); }
  bool is_leaf(NodePair pair) const { return node_a(pair).is_leaf() && node_b(pair).is_leaf(); }

  /// In the same order each time. For pairs that are not leaves.
  template <class Visit>
  void for_each_child(NodePair pair, const Visit& visit) const {
    const TreeNode &a = node_a(pair), &b = node_b(pair);
    const bool alone = is_alone(pair);
    const bool split_a = alone || splits_a(a, b), split_b = alone || splits_b(a, b);
    for (std::uint32_t i = 0; i < (split_a ? a.children : 1); ++i)
      for (std::uint32_t j = alone ? i : 0; j < (split_b ? b.children : 1); ++j)
        visit(NodePair{split_a ? a.first_child + i : pair.a, split_b ? b.first_child + j : pair.b});
  }

  std::size_t children(NodePair pair) const {
    const TreeNode &a = node_a(pair), &b = node_b(pair);
    if (is_alone(pair)) return std::size_t{a.children} * (a.children + 1) / 2;
    return std::size_t{splits_a(a, b) ? a.children : 1} * (splits_b(a, b) ? b.children : 1);
  }

  /// Of a pair that is not the root: depths tell which side came down last.
  NodePair parent(NodePair pair) const {
    const TreeNode &a = node_a(pair), &b = node_b(pair);
    if (a.depth > b.depth) return {a.parent, pair.b};
    if (a.depth < b.depth) return {pair.a, b.parent};
    const bool together = descent_ == Descent::both_sides || is_alone({a.parent, b.parent});
    return {together ? a.parent : pair.a, b.parent};
  }

  /// All pairs of objects beneath a leaf.
  template <class Visit>
  void for_each_object_pair(NodePair leaf, const Visit& visit) const {
    const Span<const std::uint32_t> a = a_.objects(leaf.a), b = b_.objects(leaf.b);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = is_alone(leaf) ? i + 1 : 0; j < b.size(); ++j) {
        const bool exchange = is_self() && b[j] < a[i];
        exchange ? visit(b[j], a[i]) : visit(a[i], b[j]);
      }
  }

 private:
  bool is_self() const { return &a_ == &b_; }
  /// A node with itself.
  bool is_alone(NodePair pair) const { return is_self() && pair.a == pair.b; }
  bool splits_a(const TreeNode& a, const TreeNode& b) const {
    return !a.is_leaf() && (descent_ == Descent::both_sides || a.depth <= b.depth || b.is_leaf());
  }
  bool splits_b(const TreeNode& a, const TreeNode& b) const {
    return !b.is_leaf() && (descent_ == Descent::both_sides || !splits_a(a, b));
  }
  const TreeNode& node_a(NodePair pair) const { return a_.nodes[pair.a]; }
  const TreeNode& node_b(NodePair pair) const { return b_.nodes[pair.b]; }

  const Tree &a_, &b_;
  Descent descent_;
};

}  // namespace boxstream::papers::volumes
