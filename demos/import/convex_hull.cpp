// SPDX-License-Identifier: MIT
#include "import/convex_hull.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <LinearMath/btConvexHullComputer.h>

#include "import/frame.hpp"
#include "import/solid.hpp"

namespace boxstream::imports {
namespace {

/// Of the cube of the diagonal. A plate of 1 m by 1 m is flat when it is thinner than 0.3 um.
constexpr double flat = 1e-7;

Hull hull_of(const std::vector<Vec3>& points) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points)
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);

  // Bullet computes in float: far from the origin, nothing would be left of a small thing.
  const Vec3 centre = times(plus(low, high), 0.5);
  std::vector<Vec3> local;
  local.reserve(points.size());
  for (const Vec3& p : points) local.push_back(minus(p, centre));
  btConvexHullComputer computer;
  computer.compute(local[0].data(), sizeof(Vec3), static_cast<int>(local.size()), 0, 0);

  Hull hull;
  for (int i = 0; i < computer.original_vertex_index.size(); ++i)
    hull.points.push_back(points[static_cast<std::size_t>(computer.original_vertex_index[i])]);
  for (int face = 0; face < computer.faces.size(); ++face) {
    const btConvexHullComputer::Edge* const first = &computer.edges[computer.faces[face]];
    const auto apex = static_cast<std::uint32_t>(first->getSourceVertex());
    for (const auto* edge = first->getNextEdgeOfFace(); edge->getTargetVertex() != first->getSourceVertex();
         edge = edge->getNextEdgeOfFace())
      hull.triangles.push_back({apex, static_cast<std::uint32_t>(edge->getSourceVertex()),
                                static_cast<std::uint32_t>(edge->getTargetVertex())});
  }
  const Solid solid = measure(hull.points, hull.triangles);
  hull.volume = std::abs(solid.volume);
  hull.centroid = solid.centroid;
  return hull;
}

/// Those that lie farthest out in directions of a Fibonacci lattice.
std::vector<Vec3> outermost(const std::vector<Vec3>& points, std::size_t directions) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < directions; ++i) {
    const double y = 1 - 2 * (static_cast<double>(i) + 0.5) / static_cast<double>(directions);
    const double r = std::sqrt(1 - y * y), angle = golden * static_cast<double>(i);
    const Vec3 direction{r * std::cos(angle), y, r * std::sin(angle)};
    const auto farthest = std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
      return dot(direction, a) < dot(direction, b);
    });
    chosen.push_back(static_cast<std::size_t>(farthest - points.begin()));
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::vector<Vec3> kept;
  for (const std::size_t i : chosen) kept.push_back(points[i]);
  return kept;
}

}  // namespace

std::optional<Hull> convex_hull(const std::vector<Vec3>& points) {
  if (points.size() < 4) return std::nullopt;
  Hull hull = hull_of(points);
  if (hull.points.size() > most_hull_points) hull = hull_of(outermost(hull.points, most_hull_points));
  double diagonal = 0;
  for (const Vec3& p : hull.points) {
    const Vec3 d = minus(p, hull.points[0]);
    diagonal = std::max(diagonal, std::sqrt(dot(d, d)));
  }
  if (!(hull.volume > flat * diagonal * diagonal * diagonal)) return std::nullopt;
  return hull;
}

}  // namespace boxstream::imports
