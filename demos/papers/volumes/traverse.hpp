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

}  // namespace boxstream::papers::volumes
