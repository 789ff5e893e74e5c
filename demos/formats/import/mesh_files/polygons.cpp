// SPDX-License-Identifier: MIT
#include "formats/import/mesh_files/polygons.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace boxstream::imports {
namespace {

struct Point {
  double x, y;
};

/// Twice the area of a triangle, positive if it turns to the left.
double turn(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Newell's: the sum over all edges, which bends of the polygon do not spoil.
std::array<double, 3> normal_of(const RawMesh& mesh, const std::uint32_t* corners, std::size_t count) {
  std::array<double, 3> normal{};
  const auto& first = mesh.vertices[corners[0]];
  for (std::size_t i = 0; i < count; ++i) {
    const auto &a = mesh.vertices[corners[i]], &b = mesh.vertices[corners[(i + 1) % count]];
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t e = (d + 1) % 3, f = (d + 2) % 3;
      // About the first corner: far from the origin sums would lose what matters.
      normal[d] += (a[e] - first[e]) * (b[f] - first[f]) - (a[f] - first[f]) * (b[e] - first[e]);
    }
  }
  return normal;
}

/// The corners as they look along an axis, counter-clockwise.
std::vector<Point> flattened(const RawMesh& mesh, const std::uint32_t* corners, std::size_t count) {
  const std::array<double, 3> normal = normal_of(mesh, corners, count);
  std::size_t along = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (std::abs(normal[d]) > std::abs(normal[along])) along = d;
  const std::size_t x = (along + 1) % 3, y = (along + 2) % 3;
  const double sign = normal[along] < 0 ? -1 : 1;
  const auto& first = mesh.vertices[corners[0]];
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& v = mesh.vertices[corners[i]];
    points.push_back({sign * (v[x] - first[x]), v[y] - first[y]});
  }
  return points;
}

bool is_convex(const std::vector<Point>& points) {
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i)
    if (turn(points[i], points[(i + 1) % count], points[(i + 2) % count]) < 0) return false;
  return true;
}

/// Whether a fan from the first corner has the polygon's own area, up to what rounding of corners on a line may do.
bool is_like_fan(const std::vector<Point>& points) {
  constexpr double rounding = 1e-4;  // of the area, or, as slivers have next to none, of the square of the length
  double area = 0, too_much = 0, length_squared = 0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const double part = turn(points[0], points[i - 1], points[i]);
    area += part;
    if (part < 0) too_much -= part;
    const double x = points[i].x - points[0].x, y = points[i].y - points[0].y;
    length_squared = std::max(length_squared, x * x + y * y);
  }
  return too_much <= rounding * std::max(area, length_squared);
}

/// Whether the corner `ear` of the rest of a polygon can be cut off: it turns to the left, and no other corner is
/// inside.
bool is_ear(const std::vector<Point>& points, const std::vector<std::size_t>& rest, std::size_t ear) {
  const std::size_t count = rest.size(), before = rest[(ear + count - 1) % count], after = rest[(ear + 1) % count];
  const Point a = points[before], b = points[rest[ear]], c = points[after];
  if (!(turn(a, b, c) > 0)) return false;
  return std::none_of(rest.begin(), rest.end(), [&](std::size_t other) {
    const Point p = points[other];
    // Corners at one place, too: a polygon with a hole goes to it and back.
    const auto is_at = [p](Point q) { return p.x == q.x && p.y == q.y; };
    if (is_at(a) || is_at(b) || is_at(c)) return false;
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
  });
}

/// Ears take time in proportion to the square of their number, and more.
constexpr std::size_t most_by_ears = 2000;

}  // namespace

void Polygons::add(const std::vector<std::uint32_t>& corners) {
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  ends_.push_back(corners_.size());
}

void Polygons::finish() {
  std::size_t begin = 0;
  for (std::size_t face = 0; face < ends_.size(); ++face) {
    for (std::size_t i = begin; i < ends_[face]; ++i)
      if (corners_[i] >= mesh_.vertices.size())
        throw std::runtime_error("face " + std::to_string(face) + " has vertex " + std::to_string(corners_[i]) +
                                 ", both from 0 on: there are " + std::to_string(mesh_.vertices.size()));
    cut(static_cast<std::uint32_t>(face), corners_.data() + begin, ends_[face] - begin);
    begin = ends_[face];
  }
}

void Polygons::cut(std::uint32_t face, const std::uint32_t* corners, std::size_t count) {
  const auto fan = [&] {
    for (std::size_t i = 2; i < count; ++i) triangle(face, corners[0], corners[i - 1], corners[i]);
  };
  if (count <= 3) return fan();
  const std::vector<Point> points = flattened(mesh_, corners, count);
  if (is_convex(points)) return fan();
  if (count > most_by_ears) {
    if (is_like_fan(points)) return fan();
    throw std::runtime_error("face " + std::to_string(face) + ", from 0 on: a face of " + std::to_string(count) +
                             " corners that is not convex");
  }
  std::vector<std::size_t> rest(count);
  for (std::size_t i = 0; i < count; ++i) rest[i] = i;
  while (rest.size() > 3) {
    std::size_t ear = 0;
    while (ear < rest.size() && !is_ear(points, rest, ear)) ++ear;
    if (ear == rest.size()) ear = 0;  // crosses itself, or has no area: any will do
    const std::size_t size = rest.size();
    triangle(face, corners[rest[(ear + size - 1) % size]], corners[rest[ear]], corners[rest[(ear + 1) % size]]);
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangle(face, corners[rest[0]], corners[rest[1]], corners[rest[2]]);
}

}  // namespace boxstream::imports
