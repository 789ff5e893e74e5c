// SPDX-License-Identifier: MIT
#include "faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

namespace boxstream::poses {
namespace {

using Vec = Eigen::Vector3d;

/// Points of one plane, in the order of their angle around their mean.
std::vector<int> in_order(const std::vector<Vec>& points, std::vector<int> face, const Vec& normal) {
  Vec middle = Vec::Zero();
  for (const int i : face) middle += points[static_cast<std::size_t>(i)];
  middle /= static_cast<double>(face.size());
  const Vec u = (points[static_cast<std::size_t>(face[0])] - middle).normalized(), v = normal.cross(u);
  const auto angle = [&](int i) {
    const Vec d = points[static_cast<std::size_t>(i)] - middle;
    return std::atan2(d.dot(v), d.dot(u));
  };
  std::sort(face.begin(), face.end(), [&](int i, int j) { return angle(i) < angle(j); });
  return face;
}

}  // namespace

std::vector<std::vector<int>> faces_of(const std::vector<Vec>& points) {
  const int count = static_cast<int>(points.size());
  const auto point = [&](int i) -> const Vec& { return points[static_cast<std::size_t>(i)]; };
  double extent = 0;
  for (const Vec& p : points) extent = std::max(extent, (p - points[0]).norm());
  std::set<std::vector<int>> found;
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      for (int k = j + 1; k < count; ++k) {
        if (i == j || i == k) continue;
        const Vec across = (point(j) - point(i)).cross(point(k) - point(i));
        if (across.norm() < 1e-9 * extent * extent) continue;
        const Vec normal = across.normalized();
        std::vector<int> face;
        bool beyond = false;
        for (int l = 0; l < count && !beyond; ++l) {
          const double height = normal.dot(point(l) - point(i));
          beyond = height > 1e-9 * extent;
          if (height > -1e-9 * extent) face.push_back(l);
        }
        if (!beyond && found.insert(face).second) faces.push_back(in_order(points, face, normal));
      }
  return faces;
}

}  // namespace boxstream::poses
