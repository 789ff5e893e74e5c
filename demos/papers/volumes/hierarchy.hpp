// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "papers/volumes/objects.hpp"
#include "papers/volumes/tree.hpp"
#include "papers/volumes/volume.hpp"

namespace boxstream::papers::volumes {

/// What a search spends: T = volume_tests C_v + primitive_tests C_p + updates C_u, with the costs of one each.
struct Counts {
  std::uint64_t volume_tests = 0;     ///< volumes compared: nodes visited
  std::uint64_t primitive_tests = 0;  ///< objects compared
  std::uint64_t updates = 0;          ///< volumes made anew because objects moved
};

/// A tree with a volume at each node.
template <Volume V>
class Hierarchy {
 public:
  /// Each volume is as tight as that kind gets: made around the corners of all objects beneath, in O(n depth), or where
  /// merging is exact around its children, in O(n).
  Hierarchy(Tree tree, const Objects& objects) : tree_(std::move(tree)), volumes_(tree_.nodes.size()) {
    for (auto node = static_cast<std::uint32_t>(volumes_.size()); node-- > 0;)
      volumes_[node] = V::merges_exactly ? renewed(node, objects) : around(node, objects);
  }

  /// For the same objects elsewhere: leaves are made anew around the corners, all others around their children's
  /// volumes, in O(n). That is as tight as new for AABBs and k-DOPs. A sphere around spheres and an OBB around OBBs are
  /// looser, the more so the higher; and a tree whose objects have mixed becomes a bad one for any kind.
  void refit(const Objects& objects, Counts& counts) {
    for (auto node = static_cast<std::uint32_t>(volumes_.size()); node-- > 0;) volumes_[node] = renewed(node, objects);
    counts.updates += volumes_.size();
  }

  const Tree& tree() const { return tree_; }
  const V& volume(std::uint32_t node) const { return volumes_[node]; }

 private:
  V renewed(std::uint32_t node, const Objects& objects) {
    const TreeNode& n = tree_.nodes[node];
    return n.is_leaf() ? around(node, objects) : V::around(Span<const V>(&volumes_[n.first_child], n.children));
  }

  V around(std::uint32_t node, const Objects& objects) {
    corners_.clear();
    for (const std::uint32_t object : tree_.objects(node)) {
      const Points corners = objects.corners(object);
      corners_.insert(corners_.end(), corners.begin(), corners.end());
    }
    return V::around(Points(corners_));
  }

  Tree tree_;
  std::vector<V> volumes_;
  std::vector<Point> corners_;  ///< scratch
};

}  // namespace boxstream::papers::volumes
