// SPDX-License-Identifier: MIT
#include "mesh/generators.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace boxstream::mesh {
namespace {

using scenes::Vec3;

constexpr double pi = std::numbers::pi;

Vec3 as_floats(const Vec3& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// An angle, as the i-th of n parts of the whole.
double part(std::size_t i, std::size_t n) {
  return 2 * pi * static_cast<double>(i) / static_cast<double>(n);
}

void require(bool fits, const char* what) {
  if (!fits) throw std::invalid_argument(what);
}

/// Two triangles between vertices a, b of a ring and c, d of the next.
void add_cell(TriangleMesh& mesh, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  const auto number = [](std::size_t i) { return static_cast<std::uint32_t>(i); };
  mesh.triangles.push_back({number(a), number(c), number(b)});
  mesh.triangles.push_back({number(b), number(c), number(d)});
}

// The bottle: a tube of radius 4 - 2 cos u around a centre line. For u in [0, pi] the line turns over the top and the
// tube with it; for u in [pi, 2 pi] it goes down to the bottom and up again through the wall, with level rings, those
// going down outside of those going up.
double centre_x(double u) {
  return 6 * std::cos(u) * (1 + std::sin(u));
}
double tube_radius(double u) {
  return 4 - 2 * std::cos(u);
}

Vec3 bottle(double u, double v) {
  const double r = tube_radius(u), y = 16 * std::sin(u);
  if (u < pi) return {centre_x(u) + r * std::cos(u) * std::cos(v), y + r * std::sin(u) * std::cos(v), r * std::sin(v)};
  return {centre_x(u) - r * std::cos(v), y, r * std::sin(v)};
}

}  // namespace

TriangleMesh klein_bottle(std::size_t n, std::size_t m) {
  require(n >= 8 && m >= 4 && m % 2 == 0, "a Klein bottle takes 8 rings, of an even number of vertices from 4 on");
  TriangleMesh mesh;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j) mesh.vertices.push_back(as_floats(bottle(part(i, n), part(j, m))));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j) {
      const std::size_t k = (j + 1) % m;
      // The last ring meets the first one backwards: v becomes pi - v.
      const auto next = [&](std::size_t c) { return i + 1 < n ? (i + 1) * m + c : (m / 2 + m - c) % m; };
      add_cell(mesh, i * m + j, i * m + k, next(j), next(k));
    }
  return mesh;
}

// At the level of y = -16 s, the two rings have their centres at x = -c and c, c = 6 (1 - s) sqrt(1 - s^2), and radii
// 4 + 2 sqrt(1 - s^2) and 4 - 2 sqrt(1 - s^2). They touch where s = 2/3, and again where s solves 2 c = 8.
std::vector<Vec3> klein_crossing(std::size_t count) {
  const auto distance = [](double s) { return 12 * (1 - s) * std::sqrt(1 - s * s); };
  double low = 0, high = 2.0 / 3;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (distance(middle) > 8 ? low : high) = middle;
  }
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double s = low + (2.0 / 3 - low) * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double q = 2 * std::sqrt(1 - s * s), gap = distance(s);
    const double x = ((4 + q) * (4 + q) - (4 - q) * (4 - q)) / (2 * gap);  // from the middle of the two centres
    const double from_outer = x + gap / 2;
    const double z = std::sqrt(std::max(0.0, (4 + q) * (4 + q) - from_outer * from_outer));
    points.push_back({x, -16 * s, z});
    points.push_back({x, -16 * s, -z});
  }
  return points;
}

TriangleMesh sphere(std::size_t n, std::size_t m, double radius) {
  require(n >= 2 && m >= 3, "a sphere takes 2 belts of 3 cells");
  TriangleMesh mesh;
  mesh.vertices.push_back(as_floats({0, radius, 0}));
  for (std::size_t i = 1; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j) {
      const double latitude = part(i, 2 * n), longitude = part(j, m);
      mesh.vertices.push_back(as_floats({radius * std::sin(latitude) * std::cos(longitude), radius * std::cos(latitude),
                                         radius * std::sin(latitude) * std::sin(longitude)}));
    }
  mesh.vertices.push_back(as_floats({0, -radius, 0}));
  const auto vertex = [&](std::size_t i, std::size_t j) { return static_cast<std::uint32_t>(1 + (i - 1) * m + j % m); };
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (std::size_t j = 0; j < m; ++j) {
    mesh.triangles.push_back({0, vertex(1, j + 1), vertex(1, j)});
    for (std::size_t i = 1; i + 1 < n; ++i)
      add_cell(mesh, vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j), vertex(i, j + 1));
    mesh.triangles.push_back({last, vertex(n - 1, j), vertex(n - 1, j + 1)});
  }
  return mesh;
}

TriangleMesh torus(std::size_t n, std::size_t m, double tube) {
  require(n >= 3 && m >= 3, "a torus takes 3 rings of 3 vertices");
  TriangleMesh mesh;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j) {
      const double u = part(i, n), v = part(j, m), r = 1 + tube * std::cos(v);
      mesh.vertices.push_back(as_floats({r * std::cos(u), tube * std::sin(v), r * std::sin(u)}));
    }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j) {
      const std::size_t next = (i + 1) % n, k = (j + 1) % m;
      add_cell(mesh, i * m + j, i * m + k, next * m + j, next * m + k);
    }
  return mesh;
}

}  // namespace boxstream::mesh
