// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include <boxstream/aabb.hpp>

#include "papers/structures/kd_tree.hpp"

/// Boxes as points: a box is the point of its six bounds, and the boxes that touch a given one are a range of such
/// points, open to one side on each axis. This is how a structure for points, such as the k-d tree, finds boxes.
namespace boxstream::papers {

using KdBoxes = KdTree<6>;

inline KdPoint<6> as_point(const Aabb& box, std::uint32_t number) {
  return {{box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]}, number};
}

/// x.min <= box.max and x.max >= box.min.
inline KdRange<6> touching(const Aabb& box) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  return {{-inf, -inf, -inf, box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2], inf, inf, inf}};
}

}  // namespace boxstream::papers
