// SPDX-License-Identifier: MIT
#include "simulation/engine/contacts/hull_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {
namespace {

using geometry::cross, geometry::dot, geometry::minus, geometry::plus;

struct Triangle {
  std::array<std::uint32_t, 3> corners;
  Vec3 normal;
  double area;
};

/// Triangles whose corners lie in one plane are one face. They come from a lattice, which puts corners of a face out of
/// its plane by a ten-thousandth of the extent.
constexpr double flat = 2e-4;

}  // namespace

HullOfFaces::HullOfFaces(const geometry::Hull& hull, const std::vector<Vec3>& points) {
  for (const Vec3& point : points) addPoint(vector(point), false);
  setMargin(0);
  recalcLocalAabb();

  Vec3 middle{};
  for (const Vec3& p : points) middle = plus(middle, times(p, 1.0 / static_cast<double>(points.size())));
  double size = 0;
  for (const Vec3& p : points) size = std::max(size, std::sqrt(dot(minus(p, middle), minus(p, middle))));
  std::vector<Triangle> triangles;
  for (const auto& t : hull.triangles) {
    Vec3 n = cross(minus(points[t[1]], points[t[0]]), minus(points[t[2]], points[t[0]]));
    const double area = std::sqrt(dot(n, n));
    if (!(area > 0)) continue;
    if (dot(n, minus(points[t[0]], middle)) < 0) n = times(n, -1);
    triangles.push_back({t, times(n, 1 / area), area});
  }
  // The largest first: the smallest lean anywhere.
  std::stable_sort(triangles.begin(), triangles.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  std::vector<bool> taken(triangles.size());
  for (std::size_t first = 0; first < triangles.size(); ++first) {
    if (taken[first]) continue;
    const Vec3 normal = triangles[first].normal;
    const double offset = dot(normal, points[triangles[first].corners[0]]);
    Face face{normal, {}};
    for (std::size_t i = first; i < triangles.size(); ++i) {
      const auto& corners = triangles[i].corners;
      const auto is_in_plane = [&](std::uint32_t c) {
        return std::abs(dot(normal, points[c]) - offset) <= flat * size;
      };
      if (taken[i] || !std::all_of(corners.begin(), corners.end(), is_in_plane) ||
          dot(triangles[i].normal, normal) < 0.9)
        continue;
      taken[i] = true;
      for (const std::uint32_t c : corners)
        if (std::find(face.corners.begin(), face.corners.end(), c) == face.corners.end()) face.corners.push_back(c);
    }
    Vec3 centre{};
    for (const std::uint32_t c : face.corners)
      centre = plus(centre, times(points[c], 1.0 / static_cast<double>(face.corners.size())));
    const Vec3 x = minus(points[face.corners[0]], centre), y = cross(normal, x);
    const auto angle = [&](std::uint32_t c) {
      const Vec3 from = minus(points[c], centre);
      return std::atan2(dot(from, y), dot(from, x));
    };
    std::sort(face.corners.begin(), face.corners.end(),
              [&](std::uint32_t a, std::uint32_t b) { return angle(a) < angle(b); });
    faces_.push_back(std::move(face));
  }
}

}  // namespace boxstream::scenes
