// SPDX-License-Identifier: MIT
#include "tessellate.hpp"

#include <numbers>

namespace boxstream::picture {
namespace {

using Corner = ShadedMesh::Corner;

// Enough that the outline of a cylinder looks round at the size of a picture.
constexpr int round_segments = 28;

void add_flat(ShadedMesh& mesh, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = normalized(cross(b - a, c - a));
  mesh.corners.insert(mesh.corners.end(), {Corner{a, n}, Corner{b, n}, Corner{c, n}});
}

/// A point of the y-symmetric frame, carried to the frame whose axis of symmetry is `axis`, orientation kept.
Vec3 to_axis(Vec3 p, int axis) {
  if (axis == 0) return {p.y, p.z, p.x};
  if (axis == 2) return {p.z, p.x, p.y};
  return p;
}

struct Profile {
  float radius, y, slope_radial, slope_y;
};

/// The surface between two rings about the y axis; `bottom` and `top` carry the radial and the y part of the normal.
void add_band(ShadedMesh& mesh, const Profile& bottom, const Profile& top, int axis) {
  const auto corner = [axis](const Profile& p, int step) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(step) / round_segments;
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    return Corner{to_axis({p.radius * c, p.y, p.radius * s}, axis),
                  to_axis(normalized({p.slope_radial * c, p.slope_y, p.slope_radial * s}), axis)};
  };
  for (int i = 0; i < round_segments; ++i) {
    const Corner a = corner(bottom, i);
    const Corner b = corner(bottom, i + 1);
    const Corner c = corner(top, i + 1);
    const Corner d = corner(top, i);
    mesh.corners.insert(mesh.corners.end(), {a, c, b, a, d, c});
  }
}

}  // namespace

ShadedMesh tessellate(const Box& box) {
  ShadedMesh mesh;
  const Vec3 h = box.half_extents;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      const auto at = [&](float u, float v) {
        const Vec3 p = to_axis({u * side, side, v}, axis);
        return p * h;
      };
      add_flat(mesh, at(-1, -1), at(-1, 1), at(1, 1));
      add_flat(mesh, at(-1, -1), at(1, 1), at(1, -1));
    }
  }
  return mesh;
}

ShadedMesh tessellate(const Cylinder& s) {
  ShadedMesh mesh;
  add_band(mesh, {s.radius, -s.half_length, 1, 0}, {s.radius, s.half_length, 1, 0}, s.axis);
  add_band(mesh, {0, -s.half_length, 0, -1}, {s.radius, -s.half_length, 0, -1}, s.axis);
  add_band(mesh, {s.radius, s.half_length, 0, 1}, {0, s.half_length, 0, 1}, s.axis);
  return mesh;
}

ShadedMesh tessellate(const Cone& s) {
  ShadedMesh mesh;
  const float h = 2 * s.half_length;
  add_band(mesh, {s.radius, -s.half_length, h, s.radius}, {0, s.half_length, h, s.radius}, s.axis);
  add_band(mesh, {0, -s.half_length, 0, -1}, {s.radius, -s.half_length, 0, -1}, s.axis);
  return mesh;
}

ShadedMesh tessellate(const Mesh& source) {
  ShadedMesh mesh;
  mesh.corners.reserve(source.triangles.size() * 3);
  for (const auto& t : source.triangles)
    add_flat(mesh, source.vertices.at(t[0]), source.vertices.at(t[1]), source.vertices.at(t[2]));
  if (!source.smooth) return mesh;

  // Area-weighted sum of the normals around each vertex.
  std::vector<Vec3> normals(source.vertices.size());
  for (const auto& t : source.triangles) {
    const Vec3 a = source.vertices[t[0]];
    const Vec3 n = cross(source.vertices[t[1]] - a, source.vertices[t[2]] - a);
    for (const std::uint32_t v : t) normals[v] = normals[v] + n;
  }
  for (std::size_t i = 0; i < mesh.corners.size(); ++i)
    mesh.corners[i].normal = normalized(normals[source.triangles[i / 3][i % 3]]);
  return mesh;
}

}  // namespace boxstream::picture
