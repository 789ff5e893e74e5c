// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "formats/import/mesh.hpp"

namespace boxstream::import_test {

using imports::TriangleMesh;
using scenes::Vec3;

/// Corners at the origin and at 1, 2 and 3 on the axes: volume 1, centroid (1/4, 1/2, 3/4).
inline TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// Adds the surface of a box, outside out.
inline void add_box(TriangleMesh& mesh, const Vec3& low, const Vec3& high) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < 8; ++i)
    mesh.vertices.push_back({i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]});
  const unsigned faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    mesh.triangles.push_back({first + f[0], first + f[1], first + f[2]});
    mesh.triangles.push_back({first + f[0], first + f[2], first + f[3]});
  }
}

/// An L of three unit cubes, extruded by 1 along z: volume 3; its convex hull has 3.5.
inline TriangleMesh ell() {
  const double outline[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  TriangleMesh mesh;
  for (const double z : {0.0, 1.0})
    for (const auto& p : outline) mesh.vertices.push_back({p[0], p[1], z});
  const unsigned top[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const auto& t : top) {
    mesh.triangles.push_back({t[2], t[1], t[0]});
    mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  for (unsigned i = 0; i < 6; ++i) {
    const unsigned j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  return mesh;
}

/// Around z.
inline TriangleMesh torus(double large, double small, unsigned around, unsigned across) {
  TriangleMesh mesh;
  for (unsigned i = 0; i < around; ++i) {
    for (unsigned j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = large + small * std::cos(v);
      mesh.vertices.push_back({r * std::cos(u), r * std::sin(u), small * std::sin(v)});
      const unsigned a = i * across + j, b = (i + 1) % around * across + j;
      const unsigned c = i * across + (j + 1) % across, d = (i + 1) % around * across + (j + 1) % across;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

inline std::string as_obj(const TriangleMesh& mesh) {
  std::ostringstream text;
  text.precision(9);
  for (const Vec3& v : mesh.vertices) text << "v " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
  for (const auto& t : mesh.triangles) text << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return text.str();
}

}  // namespace boxstream::import_test
