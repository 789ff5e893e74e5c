// SPDX-License-Identifier: MIT
#include "formats/geometry/convex_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <LinearMath/btConvexHullComputer.h>

#include "formats/geometry/frame.hpp"
#include "formats/geometry/solid.hpp"

namespace boxstream::geometry {
namespace {

/// Of the cube of the diagonal. A plate of 1 m by 1 m is flat when it is thinner than 0.3 um.
constexpr double flat = 1e-7;

/// The faces of a computed hull, cut into triangles.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const btConvexHullComputer& computer) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (int face = 0; face < computer.faces.size(); ++face) {
    const btConvexHullComputer::Edge* const first = &computer.edges[computer.faces[face]];
    const auto apex = static_cast<std::uint32_t>(first->getSourceVertex());
    for (const auto* edge = first->getNextEdgeOfFace(); edge->getTargetVertex() != first->getSourceVertex();
         edge = edge->getNextEdgeOfFace())
      triangles.push_back({apex, static_cast<std::uint32_t>(edge->getSourceVertex()),
                           static_cast<std::uint32_t>(edge->getTargetVertex())});
  }
  return triangles;
}

/// Of the points as they are (0), or turned about a skew axis by that many radians.
Hull hull_of(const std::vector<Vec3>& points, double turn) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points)
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);

  // Bullet computes in float: far from the origin, nothing would be left of a small thing.
  const Vec3 centre = times(plus(low, high), 0.5);
  std::vector<Vec3> local;
  local.reserve(points.size());
  const double s = std::sin(turn / 2) / std::sqrt(14.0);
  const Quat skew{s, 2 * s, 3 * s, std::cos(turn / 2)};
  for (const Vec3& p : points) {
    const Vec3 from = minus(p, centre);
    local.push_back(turn == 0 ? from : turned(skew, from));
  }
  btConvexHullComputer computer;
  computer.compute(local[0].data(), sizeof(Vec3), static_cast<int>(local.size()), 0, 0);

  Hull hull;
  for (int i = 0; i < computer.original_vertex_index.size(); ++i)
    hull.points.push_back(points[static_cast<std::size_t>(computer.original_vertex_index[i])]);
  hull.triangles = triangles_of(computer);
  const Solid solid = measure(hull.points, hull.triangles);
  hull.volume = std::abs(solid.volume);
  hull.centroid = solid.centroid;
  return hull;
}

struct Side {
  Vec3 normal;    // outwards, of length 1
  double offset;  // of the farthest corner: a face between corners that lie close together leans anywhere
};

std::vector<Side> sides_of(const Hull& hull) {
  std::vector<Side> sides;
  for (const auto& t : hull.triangles) {
    const Vec3& a = hull.points[t[0]];
    const Vec3 n = cross(minus(hull.points[t[1]], a), minus(hull.points[t[2]], a));
    const double length = std::sqrt(dot(n, n));
    if (!(length > 0)) continue;
    const Vec3 normal = times(n, (dot(n, minus(hull.centroid, a)) > 0 ? -1 : 1) / length);
    double offset = dot(normal, a);
    for (const Vec3& corner : hull.points) offset = std::max(offset, dot(normal, corner));
    sides.push_back({normal, offset});
  }
  return sides;
}

double excess(const std::vector<Side>& sides, const Vec3& point) {
  double most = 0;
  for (const Side& side : sides) most = std::max(most, dot(side.normal, point) - side.offset);
  return most;
}

/// How far the farthest of the points sticks out of the hull.
double excess(const Hull& hull, const std::vector<Vec3>& points) {
  const std::vector<Side> sides = sides_of(hull);
  double most = 0;
  for (const Vec3& p : points) most = std::max(most, excess(sides, p));
  return most;
}

/// Corners of the hull and points outside of it: they have the same hull as all of the points.
std::vector<Vec3> not_inside(const Hull& hull, const std::vector<Vec3>& points) {
  const std::vector<Side> sides = sides_of(hull);
  std::vector<Vec3> kept = hull.points;
  for (const Vec3& p : points)
    if (excess(sides, p) > 0) kept.push_back(p);
  return kept;
}

double extent_of(const std::vector<Vec3>& points) {
  double most = 0;
  for (const Vec3& p : points) {
    const Vec3 d = minus(p, points[0]);
    most = std::max(most, std::sqrt(dot(d, d)));
  }
  return most;
}

/// Without those that are nearer than `least` to one that stays.
std::vector<Vec3> thinned(const std::vector<Vec3>& points, double least) {
  std::vector<Vec3> kept;
  for (const Vec3& p : points)
    if (std::all_of(kept.begin(), kept.end(), [&](const Vec3& q) {
          const Vec3 d = minus(p, q);
          return dot(d, d) >= least * least;
        }))
      kept.push_back(p);
  return kept;
}

/// Bullet's computer loses corners of some sets, which it finds when they are turned. It works on a grid of a ten
/// thousandth of the extent: the faces between corners that are nearer to each other lean anywhere.
Hull hull_of(const std::vector<Vec3>& all) {
  const double enough = 3e-4 * extent_of(all);
  Hull best = hull_of(all, 0);
  // Of a mesh, most points lie inside at once. A flat hull has no inside.
  const std::vector<Vec3> points = best.volume > 0 ? not_inside(best, all) : all;
  const auto out_of = [&](const Hull& hull) {
    return hull.volume > 0 ? excess(hull, points) : std::numeric_limits<double>::max();
  };
  double least = out_of(best);
  const auto consider = [&](Hull hull) {
    const double out = out_of(hull);
    if (out < least) best = std::move(hull), least = out;
  };
  for (int turn = 0; turn < 16 && least > enough; ++turn) {
    const Hull hull = turn == 0 ? best : hull_of(points, static_cast<double>(turn));
    if (turn > 0) consider(hull);
    if (least > enough && !hull.points.empty())
      consider(hull_of(thinned(hull.points, enough), static_cast<double>(turn)));
  }
  return best;
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

std::optional<Hull> shrunk(const Hull& hull, double depth) {
  std::vector<Vec3> local;
  for (const Vec3& p : hull.points) local.push_back(minus(p, hull.centroid));
  btConvexHullComputer computer;
  const auto shift = static_cast<btScalar>(depth);
  // What it gives back is by how much it moved them, or less than that where the hull would be gone.
  if (computer.compute(local[0].data(), sizeof(Vec3), static_cast<int>(local.size()), shift, 0) < shift)
    return std::nullopt;
  Hull result;
  for (int i = 0; i < computer.vertices.size(); ++i) {
    const btVector3& v = computer.vertices[i];
    result.points.push_back(plus(hull.centroid, {double{v.x()}, double{v.y()}, double{v.z()}}));
  }
  result.triangles = triangles_of(computer);
  const Solid solid = solid_of(result);
  result.volume = solid.volume;
  result.centroid = solid.centroid;
  if (!(result.volume > 0)) return std::nullopt;
  return result;
}

Solid solid_of(const Hull& hull) {
  const Solid solid = measure(hull.points, hull.triangles);
  return solid.volume < 0 ? Solid{-solid.volume, solid.centroid, scaled(solid.inertia, -1)} : solid;
}

Hull rough_hull(const std::vector<Vec3>& points) {
  return points.size() < 4 ? Hull{} : hull_of(points, 0);
}

std::optional<Hull> convex_hull(const std::vector<Vec3>& points) {
  if (points.size() < 4) return std::nullopt;
  // Thousands of corners are looked at by no more than the ones that stay.
  const bool too_many = rough_hull(points).points.size() > most_hull_points;
  Hull hull = hull_of(too_many ? outermost(points, most_hull_points) : points);
  if (hull.points.size() > most_hull_points) hull = hull_of(outermost(hull.points, most_hull_points));
  if (hull.points.empty()) return std::nullopt;
  const double diagonal = extent_of(hull.points);
  if (!(hull.volume > flat * diagonal * diagonal * diagonal)) return std::nullopt;
  return hull;
}

}  // namespace boxstream::geometry
