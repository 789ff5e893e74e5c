// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace boxstream::report::narrow {

struct Mesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
};

/// An icosahedron divided until it has at least `triangles` (20, 80, 320 ...): points are on the unit sphere, the
/// faces inside.
Mesh sphere_mesh(int triangles);

/// How far the nearest face is from the origin.
double inner_radius(const Mesh& mesh);

}  // namespace boxstream::report::narrow
