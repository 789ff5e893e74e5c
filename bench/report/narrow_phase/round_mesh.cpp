// SPDX-License-Identifier: MIT
#include "narrow_phase/round_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace boxstream::report::narrow {
namespace {

Mesh icosahedron() {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double one : {-1.0, 1.0})
      for (const double golden : {-std::numbers::phi, std::numbers::phi}) {
        Eigen::Vector3d p = Eigen::Vector3d::Zero();
        p[(axis + 1) % 3] = one;
        p[(axis + 2) % 3] = golden;
        mesh.points.push_back(p.normalized());
      }
  // Neighbours are closest: every three of them that are neighbours of each other are a face.
  const double edge = 2 / std::sqrt(2 + std::numbers::phi);
  const auto at = [&](int i) { return mesh.points[static_cast<std::size_t>(i)]; };
  const auto near = [&](int i, int j) { return (at(i) - at(j)).norm() < 1.1 * edge; };
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j)
      for (int k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
        const bool outward = at(i).dot(at(j).cross(at(k))) > 0;
        mesh.triangles.push_back(outward ? std::array{i, j, k} : std::array{i, k, j});
      }
  return mesh;
}

Mesh divided(const Mesh& coarse) {
  Mesh mesh{coarse.points, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int i, int j) {
    const auto [place, is_new] =
        middles.insert({{std::min(i, j), std::max(i, j)}, static_cast<int>(mesh.points.size())});
    if (is_new)
      mesh.points.push_back(
          (mesh.points[static_cast<std::size_t>(i)] + mesh.points[static_cast<std::size_t>(j)]).normalized());
    return place->second;
  };
  for (const auto& [i, j, k] : coarse.triangles) {
    const int ij = middle(i, j), jk = middle(j, k), ki = middle(k, i);
    for (const auto& face : {std::array{i, ij, ki}, {j, jk, ij}, {k, ki, jk}, {ij, jk, ki}})
      mesh.triangles.push_back(face);
  }
  return mesh;
}

}  // namespace

Mesh sphere_mesh(int triangles) {
  Mesh mesh = icosahedron();
  while (static_cast<int>(mesh.triangles.size()) < triangles) mesh = divided(mesh);
  return mesh;
}

double inner_radius(const Mesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.points[static_cast<std::size_t>(i)], &b = mesh.points[static_cast<std::size_t>(j)],
                          &c = mesh.points[static_cast<std::size_t>(k)];
    least = std::min(least, (b - a).cross(c - a).normalized().dot(a));
  }
  return least;
}

}  // namespace boxstream::report::narrow
