// SPDX-License-Identifier: MIT
#include "formats/import/clip.hpp"

#include <algorithm>

#include "formats/import/geometry.hpp"

namespace boxstream::imports {
namespace {

/// Where the edge meets the plane: the same point, to the last bit, for both triangles that share the edge.
Vec3 meet(Vec3 a, Vec3 b, std::size_t axis, double value) {
  if (b < a) std::swap(a, b);
  Vec3 point = plus(a, times(minus(b, a), (value - a[axis]) / (b[axis] - a[axis])));
  point[axis] = value;
  return point;
}

/// One side of a triangle that the plane goes through: three or four corners, in the triangle's sense.
void add_side(const Facet& facet, std::size_t axis, double value, double side, std::vector<Facet>& out) {
  std::array<Vec3, 4> corners;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = facet.corners[i], &b = facet.corners[(i + 1) % 3];
    const double from = (a[axis] - value) * side, to = (b[axis] - value) * side;
    if (from >= 0) corners[count++] = a;
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) corners[count++] = meet(a, b, axis, value);
  }
  for (std::size_t i = 2; i < count; ++i) out.push_back({{corners[0], corners[i - 1], corners[i]}, facet.cap});
}

/// Closes one half: a fan over its edges that lie in the plane. Edges inside its surface appear in both directions and
/// cancel.
void close(std::vector<Facet>& half, std::size_t axis, double value) {
  const std::size_t count = half.size();
  const Vec3* apex = nullptr;
  std::vector<Facet> caps;
  for (std::size_t f = 0; f < count; ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &from = half[f].corners[i], &to = half[f].corners[(i + 1) % 3];
      if (from[axis] != value || to[axis] != value) continue;
      if (apex == nullptr) apex = &from;
      if (from != *apex && to != *apex && from != to) caps.push_back({{*apex, to, from}, true});
    }
  }
  half.insert(half.end(), caps.begin(), caps.end());
}

}  // namespace

Halves clip(const std::vector<Facet>& facets, std::size_t axis, double value) {
  Halves halves;
  for (const Facet& facet : facets) {
    const auto& c = facet.corners;
    const auto [low, high] = std::minmax({c[0][axis], c[1][axis], c[2][axis]});
    if (low == value && high == value) {
      // In the plane: the solid is behind it.
      const Vec3 normal = cross(minus(c[1], c[0]), minus(c[2], c[0]));
      (normal[axis] > 0 ? halves.low : halves.high).push_back(facet);
    } else if (high <= value) {
      halves.low.push_back(facet);
    } else if (low >= value) {
      halves.high.push_back(facet);
    } else {
      add_side(facet, axis, value, -1, halves.low);
      add_side(facet, axis, value, 1, halves.high);
    }
  }
  close(halves.low, axis, value);
  close(halves.high, axis, value);
  return halves;
}

double signed_volume(const std::vector<Facet>& facets) {
  if (facets.empty()) return 0;
  const Vec3 apex = facets[0].corners[0];
  double six_times = 0;
  for (const Facet& f : facets)
    six_times += dot(minus(f.corners[0], apex), cross(minus(f.corners[1], apex), minus(f.corners[2], apex)));
  return six_times / 6;
}

}  // namespace boxstream::imports
