// SPDX-License-Identifier: MIT
#include "mesh/self_intersection.hpp"

#include <algorithm>
#include <boxstream/detector.hpp>
#include <limits>

namespace boxstream::mesh {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Brings what `s` and `t` share to their fronts, and returns how much that is.
std::size_t bring_shared_to_front(Corners& s, Corners& t) {
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = shared; j < 3; ++j)
      if (s[i] == t[j]) {
        std::swap(s[shared], s[i]);
        std::swap(t[shared], t[j]);
        ++shared;
        break;
      }
  return shared;
}

Triangle placed(const TriangleMesh& mesh, const Corners& c) {
  return {mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]]};
}

}  // namespace

bool intersect(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t second) {
  Corners a = mesh.triangles[first], b = mesh.triangles[second];
  const std::size_t shared = bring_shared_to_front(a, b);
  const Triangle s = placed(mesh, a), t = placed(mesh, b);
  switch (shared) {
    case 0:
      return meet(s, t);
    case 1:
      return meet_beyond_corner(s, t);
    case 2:
      return meet_beyond_edge(s, t);
    default:
      return true;
  }
}

SelfIntersections self_intersections(const TriangleMesh& mesh) {
  check(mesh);
  SelfIntersections result;
  std::vector<Aabb> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle t = triangle_of(mesh, i);
    boxes.push_back(box_of(t));
    if (has_area(t)) continue;
    result.without_area.push_back(i);
    boxes.back().min[0] = std::numeric_limits<float>::quiet_NaN();  // pairs with nothing
  }
  Detector().stream_pairs(boxes, [&](Span<const Pair> candidates) {
    result.candidates += candidates.size();
    for (const Pair pair : candidates)
      if (intersect(mesh, pair.a, pair.b)) result.pairs.push_back(pair);
    return true;
  });
  std::sort(result.pairs.begin(), result.pairs.end());
  return result;
}

}  // namespace boxstream::mesh
