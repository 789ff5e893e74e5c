// SPDX-License-Identifier: MIT
#include "simulation/query/meshes.hpp"

#include <cmath>
#include <numbers>

namespace boxstream::query {

scenes::MeshShape ring_mesh(double radius, double tube, int around, int across) {
  scenes::MeshShape mesh;
  for (int i = 0; i < around; ++i) {
    const double u = 2 * std::numbers::pi * i / around;
    for (int j = 0; j < across; ++j) {
      const double v = 2 * std::numbers::pi * j / across;
      const double out = radius + tube * std::cos(v);
      mesh.vertices.push_back({out * std::cos(u), tube * std::sin(v), out * std::sin(u)});
    }
  }
  const auto corner = [&](int i, int j) { return static_cast<std::uint32_t>(i % around * across + j % across); };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({corner(i, j), corner(i, j + 1), corner(i + 1, j)});
      mesh.triangles.push_back({corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1)});
    }
  }
  return mesh;
}

scenes::MeshShape bracket_mesh(double length, double width, double thickness) {
  const double s = length, t = thickness;
  // Counter-clockwise, around the middle of the square that holds the L.
  const double outline[6][2] = {{0, 0}, {s, 0}, {s, t}, {t, t}, {t, s}, {0, s}};
  scenes::MeshShape mesh;
  for (const double z : {-width / 2, width / 2})
    for (const auto& [x, y] : outline) mesh.vertices.push_back({x - s / 2, y - s / 2, z});
  // The two ends, each as two quadrilaterals.
  const std::uint32_t end[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const auto& [a, b, c] : end) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + 6, b + 6, c + 6});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t next = (i + 1) % 6;
    mesh.triangles.push_back({i, next, next + 6});
    mesh.triangles.push_back({i, next + 6, i + 6});
  }
  return mesh;
}

}  // namespace boxstream::query
