// SPDX-License-Identifier: MIT
#include "pictures/solids/surface.hpp"

#include <cmath>
#include <numbers>

namespace boxstream::solids {
namespace {

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
/// Up where there is no direction, since normals must have unit length.
Point unit(const Point& a) {
  const double length = std::hypot(static_cast<double>(a[0]), a[1], a[2]);
  if (!(length > 0) || !std::isfinite(length)) return {0, 1, 0};
  return {static_cast<float>(a[0] / length), static_cast<float>(a[1] / length), static_cast<float>(a[2] / length)};
}

void add_flat(Surface& surface, const Point& a, const Point& b, const Point& c) {
  const Point normal = unit(cross(minus(b, a), minus(c, a)));
  for (const Point& p : {a, b, c}) {
    surface.indices.push_back(static_cast<std::uint32_t>(surface.positions.size()));
    surface.positions.push_back(p);
    surface.normals.push_back(normal);
  }
}

/// One ring of a surface of revolution about y.
struct Ring {
  float radius, y;
  float slope_radius, slope_y;  // the normal
};

/// From the top ring to the bottom one. Two equal rings with different normals make an edge.
Surface revolved(const std::vector<Ring>& rings, int segments) {
  Surface surface;
  for (const Ring& ring : rings) {
    for (int i = 0; i <= segments; ++i) {
      const float angle =
          2 * std::numbers::pi_v<float> * static_cast<float>(i % segments) / static_cast<float>(segments);
      const float c = std::cos(angle);
      const float s = std::sin(angle);
      surface.positions.push_back({ring.radius * c, ring.y, ring.radius * s});
      surface.normals.push_back(unit({ring.slope_radius * c, ring.slope_y, ring.slope_radius * s}));
    }
  }
  const auto around = static_cast<std::uint32_t>(segments), row = around + 1;
  for (std::uint32_t r = 0; r + 1 < rings.size(); ++r) {
    const bool same = rings[r].radius == rings[r + 1].radius && rings[r].y == rings[r + 1].y;
    if (same) continue;
    for (std::uint32_t i = r * row; i < r * row + around; ++i) {
      // At a pole one of the two triangles has no area.
      if (rings[r].radius > 0) surface.indices.insert(surface.indices.end(), {i, i + 1, i + row});
      if (rings[r + 1].radius > 0) surface.indices.insert(surface.indices.end(), {i + 1, i + row + 1, i + row});
    }
  }
  return surface;
}

}  // namespace

Surface box(const Point& half_extents) {
  Surface surface;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      const auto corner = [&](float u, float v) {
        Point p{};
        p[axis] = side * half_extents[axis];
        p[(axis + 1) % 3] = side * u * half_extents[(axis + 1) % 3];
        p[(axis + 2) % 3] = v * half_extents[(axis + 2) % 3];
        return p;
      };
      const auto first = static_cast<std::uint32_t>(surface.positions.size());
      Point normal{};
      normal[axis] = side;
      for (const Point& p : {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}) {
        surface.positions.push_back(p);
        surface.normals.push_back(normal);
      }
      surface.indices.insert(surface.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
  }
  return surface;
}

Surface cylinder(float r, float h, int segments) {
  return revolved({{0, h, 0, 1}, {r, h, 0, 1}, {r, h, 1, 0}, {r, -h, 1, 0}, {r, -h, 0, -1}, {0, -h, 0, -1}}, segments);
}

Surface cone(float r, float h, int segments) {
  return revolved({{0, h, 2 * h, r}, {r, -h, 2 * h, r}, {r, -h, 0, -1}, {0, -h, 0, -1}}, segments);
}

Surface capsule(float radius, float half_length, int segments) {
  const int quarter = segments / 4;  // from the equator to a pole
  std::vector<Ring> rings;
  for (const float side : {1.0F, -1.0F}) {
    for (int i = 0; i <= quarter; ++i) {
      const int from_pole = side > 0 ? i : quarter - i;
      const float angle = std::numbers::pi_v<float> / 2 * static_cast<float>(from_pole) / static_cast<float>(quarter);
      // Exact at the pole and at the equator, where rings are to coincide.
      const float out = from_pole == 0 ? 0 : from_pole == quarter ? 1 : std::sin(angle);
      const float up = from_pole == quarter ? 0 : std::cos(angle);
      rings.push_back({radius * out, side * (half_length + radius * up), out, side * up});
    }
  }
  return revolved(rings, segments);
}

Surface square(float half) {
  Surface surface;
  add_flat(surface, {-half, 0, -half}, {-half, 0, half}, {half, 0, half});
  add_flat(surface, {-half, 0, -half}, {half, 0, half}, {half, 0, -half});
  return surface;
}

Surface flat(Span<const Point> vertices, Span<const Triangle> triangles) {
  Surface surface;
  for (const Triangle& t : triangles) add_flat(surface, vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  return surface;
}

Surface smooth(Span<const Point> vertices, Span<const Triangle> triangles) {
  Surface surface;
  surface.positions.assign(vertices.begin(), vertices.end());
  surface.normals.resize(vertices.size());
  for (const Triangle& t : triangles) {
    const Point& a = vertices[t[0]];
    const Point normal = cross(minus(vertices[t[1]], a), minus(vertices[t[2]], a));
    for (const std::uint32_t corner : t) {
      for (std::size_t d = 0; d < 3; ++d) surface.normals[corner][d] += normal[d];
      surface.indices.push_back(corner);
    }
  }
  for (Point& normal : surface.normals) normal = unit(normal);
  return surface;
}

}  // namespace boxstream::solids
