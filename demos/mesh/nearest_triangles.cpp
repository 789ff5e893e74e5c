// SPDX-License-Identifier: MIT
#include "mesh/nearest_triangles.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace boxstream::mesh {

NearestTriangles::NearestTriangles(const TriangleMesh& mesh) {
  check(mesh);
  if (mesh.triangles.empty()) throw std::invalid_argument("a mesh without triangles has no distance to anything");
  std::vector<Aabb> boxes;
  std::vector<std::uint64_t> numbers;
  triangles_.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    triangles_.emplace_back(triangle_of(mesh, i));
    boxes.push_back(box_of(triangle_of(mesh, i)));
    numbers.push_back(i);
  }
  std::vector<ProxyId> ids(boxes.size());
  world_.create(boxes, {}, ids, numbers);
}

Nearest NearestTriangles::nearest(const Vec3& point, std::uint32_t hint) const {
  Nearest best;
  const auto look_at = [&](std::uint32_t triangle) {
    const double squared = triangles_[triangle].squared(point, best.squared);
    if (squared < best.squared) best = {squared, triangle};
    // Beyond it all is farther for certain: boxes are nearer than what is in them, their distances rounded down.
    return std::nextafter(rounded_up(std::sqrt(best.squared)), std::numeric_limits<float>::infinity());
  };
  float limit = std::numeric_limits<float>::infinity();
  if (hint != Nearest::none) limit = look_at(hint);
  world_.query_nearest_box(box_of(point), limit,
                           [&](ProxyId id, float) { return look_at(static_cast<std::uint32_t>(world_.user(id))); });
  return best;
}

std::vector<Nearest> NearestTriangles::nearest(const std::vector<Vec3>& points) const {
  check(points);
  std::vector<Nearest> result;
  result.reserve(points.size());
  for (const Vec3& point : points)
    result.push_back(nearest(point, result.empty() ? Nearest::none : result.back().triangle));
  return result;
}

}  // namespace boxstream::mesh
