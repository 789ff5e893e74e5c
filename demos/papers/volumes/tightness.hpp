// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <boxstream/function_ref.hpp>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "papers/volumes/hierarchy.hpp"
#include "papers/volumes/oriented_box.hpp"
#include "papers/volumes/volume.hpp"

/// The two measures of how tight a volume is.
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

/// The box { centre + axes u : |u[i]| <= half[i] }.
struct Frame {
  Point centre;
  Eigen::Matrix3d axes;
  Point half;
};

template <Volume V>
Frame frame_around(const V& v) {
  const Aabb64 box = v.bounds();
  const Point low(box.min), high(box.max);
  return {(low + high) / 2, Eigen::Matrix3d::Identity(), (high - low) / 2};
}
inline Frame frame_around(const OrientedBox& v) {
  return {v.centre, v.axes, v.half};
}

/// The directed Hausdorff distance of Definition 3: max over b in B of `distance(b)`, that from b to the geometry.
/// B is where `excess` is at most 0 (see Volume), within `frame`. The result is below the true value by `tolerance` at
/// most, or by a few times that where corners of B are sharp.
///
/// Branch and bound: distances change no faster than places, so the middle of a cell bounds them in all of it.
double directed_hausdorff(const Frame& frame, FunctionRef<double(const Point&)> excess,
                          FunctionRef<double(const Point&)> distance, double tolerance);

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
