// SPDX-License-Identifier: MIT
#include "import/convex_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "import/clip.hpp"
#include "import/frame.hpp"
#include "import/solid.hpp"

namespace boxstream::imports {
namespace {

/// Planes that are tried across each axis: at vertices, where notches end, and in between.
constexpr std::size_t planes_at_vertices = 8;
constexpr std::size_t planes_between = 7;

/// Less than this fraction of the whole is nothing.
constexpr double least_gain = 1e-4;

std::vector<Vec3> surface_points(const std::vector<Facet>& facets) {
  std::vector<Vec3> points;
  for (const Facet& facet : facets)
    if (!facet.cap) points.insert(points.end(), facet.corners.begin(), facet.corners.end());
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

constexpr double no_place = std::numeric_limits<double>::infinity();

struct Cut {
  std::size_t axis = 0;
  double value = no_place;
  double gain = 0;  // hull volume that it takes away
};

struct Part {
  std::vector<Facet> facets;
  Hull hull;
  Cut best;
  double excess = 0;  // of the hull's volume over that of the part, where it has one
};

std::vector<double> planes_to_try(const std::vector<Vec3>& points, std::size_t axis) {
  std::vector<double> values;
  for (const Vec3& p : points) values.push_back(p[axis]);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  const double low = values.front(), high = values.back();
  std::vector<double> planes;
  for (std::size_t i = 1; i <= planes_at_vertices; ++i)
    planes.push_back(values[i * (values.size() - 1) / (planes_at_vertices + 1)]);
  for (std::size_t i = 1; i <= planes_between; ++i)
    planes.push_back(low + (high - low) * static_cast<double>(i) / (planes_between + 1));
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  std::erase_if(planes, [&](double x) { return !(low < x && x < high); });
  return planes;
}

Cut best_cut(const Part& part, double least) {
  Cut best;
  const std::vector<Vec3> points = surface_points(part.facets);
  double middle_of = 0;  // the extent that is cut in the middle if no cut takes anything away
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                                 [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    const double extent = (*high)[axis] - (*low)[axis], middle = (*low)[axis] + extent / 2;
    for (const double value : planes_to_try(points, axis)) {
      const Halves halves = clip(part.facets, axis, value);
      const auto first = convex_hull(surface_points(halves.low)), second = convex_hull(surface_points(halves.high));
      if (!first || !second) continue;
      const double gain = part.hull.volume - first->volume - second->volume;
      if (gain > std::max(best.gain, least)) {
        best = {axis, value, gain};
      } else if (best.gain <= least && value == middle && extent > middle_of) {
        best = {axis, value, gain};
        middle_of = extent;
      }
    }
  }
  return best;
}

Part make_part(std::vector<Facet> facets, double least) {
  auto hull = convex_hull(surface_points(facets));
  if (!hull) throw std::runtime_error("the mesh is flat");
  Part part{std::move(facets), std::move(*hull), {}, 0};
  part.excess = part.hull.volume - std::abs(signed_volume(part.facets));
  part.best = best_cut(part, least);
  return part;
}

bool can_be_cut(const Part& part) {
  return part.best.value != no_place;
}

/// The part to cut next. In a solid that is the one with most too much: a ring cut in halves has as much too much as
/// before, but its quarters have less. In an open mesh it is the one whose cut takes away most.
Part& next_of(std::vector<Part>& parts, bool solid) {
  return *std::max_element(parts.begin(), parts.end(), [solid](const Part& a, const Part& b) {
    if (can_be_cut(a) != can_be_cut(b)) return can_be_cut(b);
    return solid ? a.excess < b.excess : a.best.gain < b.best.gain;
  });
}

}  // namespace

ConvexParts convex_parts(const TriangleMesh& mesh, const PartsOptions& options) {
  if (mesh.triangles.size() > most_triangles)
    throw std::runtime_error("a mesh of more than " + std::to_string(most_triangles) + " triangles is not cut up");
  std::vector<Facet> facets;
  for (const auto& t : mesh.triangles)
    facets.push_back({{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}});
  const bool closed = is_closed(mesh.triangles);
  const double volume = std::abs(signed_volume(facets));
  const auto whole_hull = convex_hull(mesh.vertices);
  if (!whole_hull) throw std::runtime_error("the mesh is flat");
  const double least = least_gain * whole_hull->volume;
  const bool solid = closed && volume > least;

  std::vector<Part> parts;
  parts.push_back(make_part(std::move(facets), least));
  const auto hull_volume = [&] {
    double sum = 0;
    for (const Part& part : parts) sum += part.hull.volume;
    return sum;
  };
  while (parts.size() < options.max_hulls && !(solid && hull_volume() - volume <= options.max_error * volume)) {
    Part& next = next_of(parts, solid);
    if (!can_be_cut(next)) break;
    if (solid ? next.excess <= least : next.best.gain <= std::max(least, options.max_error * whole_hull->volume)) break;
    Halves halves = clip(next.facets, next.best.axis, next.best.value);
    next = make_part(std::move(halves.low), least);
    parts.push_back(make_part(std::move(halves.high), least));
  }

  ConvexParts result;
  if (solid) result.error = hull_volume() / volume - 1;
  for (Part& part : parts) result.hulls.push_back(std::move(part.hull));
  return result;
}

}  // namespace boxstream::imports
