// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "papers/volumes/hierarchy.hpp"
#include "papers/volumes/recursion.hpp"

namespace boxstream::papers::volumes {

/// traverse(A, B) of section 5.2: all pairs of an object of `a` with an object of `b` for which `meets` is true, each
/// once, to `found`. Both are called with (object of a, object of b). Where `a` and `b` are the same hierarchy: the
/// pairs within it, the smaller number first.
///
/// Volumes are compared at leaves, too.
template <Volume V, class Meets, class Found>
void traverse(const Hierarchy<V>& a, const Hierarchy<V>& b, Descent descent, const Meets& meets, const Found& found,
              Counts& counts) {
  const Recursion recursion(a.tree(), b.tree(), descent);
  std::vector<NodePair> open;
  if (!recursion.is_empty()) open.push_back(recursion.root());
  while (!open.empty()) {
    const NodePair pair = open.back();
    open.pop_back();
    ++counts.volume_tests;
    if (!overlap(a.volume(pair.a), b.volume(pair.b))) continue;
    if (!recursion.is_leaf(pair)) {
      recursion.for_each_child(pair, [&](NodePair child) { open.push_back(child); });
      continue;
    }
    recursion.for_each_object_pair(pair, [&](std::uint32_t i, std::uint32_t j) {
      ++counts.primitive_tests;
      if (meets(i, j)) found(i, j);
    });
  }
}

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
