// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace boxstream::poses {

/// The faces of the convex hull of a few dozen points, all of them corners: each plane through three points with none
/// beyond it, its points counter-clockwise from outside.
std::vector<std::vector<int>> faces_of(const std::vector<Eigen::Vector3d>& points);

}  // namespace boxstream::poses
