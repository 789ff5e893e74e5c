// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "papers/volumes/hausdorff.hpp"
#include "papers/volumes/nearest.hpp"

/// The two measures of how tight a volume is.
namespace boxstream::papers::volumes {

/// Definition 3, h(B, G) / diam(G): B is the volume of `node`, and G all objects beneath; `distance(object, p)` is that
/// of one of them from a point. Within `tolerance`, as a part of the diameter, of the true value (see
/// directed_hausdorff). 0 is a volume that is its content. Where the content is a point, NaN.
///
/// B is solid: around a closed surface, the point that is farthest from it can be one that it encloses.
/// O(c^2) for the diameter, with c corners beneath.
template <Volume V, class Distance>
double hausdorff_tightness(const Hierarchy<V>& hierarchy, std::uint32_t node, const Objects& objects,
                           const Distance& distance, double tolerance) {
  std::vector<Point> corners;
  for (const std::uint32_t object : hierarchy.tree().objects(node))
    for (const Point& corner : objects.corners(object)) corners.push_back(corner);
  double square = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) square = std::max(square, (corners[i] - corners[j]).squaredNorm());
  const double diameter = std::sqrt(square);
  if (diameter == 0) return std::numeric_limits<double>::quiet_NaN();
  const V& v = hierarchy.volume(node);
  const auto nearest = [&](const Point& p) {
    return distance_to_nearest(hierarchy, node, p, [&](std::uint32_t object) { return distance(object, p); });
  };
  const auto excess = [&](const Point& p) { return v.excess(p); };
  return directed_hausdorff(frame_around(v), excess, nearest, tolerance * diameter) / diameter;
}

/// Definition 4, for each node: its volume over the sum of those of its children, or of all leaves beneath. NaN where
/// that sum is 0, and at leaves.
///
/// It compares a hierarchy with itself: where children overlap, it is below 1, and volumes that are all loose by the
/// same part are as tight as those that are not loose at all.
struct VolumeTightness {
  std::vector<double> by_children, by_leaves;
};

template <Volume V>
VolumeTightness volume_tightness(const Hierarchy<V>& hierarchy) {
  const std::vector<TreeNode>& nodes = hierarchy.tree().nodes;
  std::vector<double> of_children(nodes.size(), 0), of_leaves(nodes.size(), 0);
  VolumeTightness tightness;
  tightness.by_children.assign(nodes.size(), std::numeric_limits<double>::quiet_NaN());
  tightness.by_leaves = tightness.by_children;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const double volume = hierarchy.volume(static_cast<std::uint32_t>(i)).volume();
    if (!nodes[i].is_leaf()) {
      if (of_children[i] > 0) tightness.by_children[i] = volume / of_children[i];
      if (of_leaves[i] > 0) tightness.by_leaves[i] = volume / of_leaves[i];
    }
    if (i == 0) continue;
    of_children[nodes[i].parent] += volume;
    of_leaves[nodes[i].parent] += nodes[i].is_leaf() ? volume : of_leaves[i];
  }
  return tightness;
}

}  // namespace boxstream::papers::volumes
