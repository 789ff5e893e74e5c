// SPDX-License-Identifier: MIT
#include "formats/import/convex_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "formats/import/clip.hpp"
#include "formats/import/geometry.hpp"

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

struct CutPoints {
  std::vector<Vec3> low, high;  // corners in the plane are those of the half that their edges go to
};

/// Where edges of the surface meet the plane.
CutPoints cut_points(const std::vector<Facet>& facets, std::size_t axis, double value) {
  CutPoints points;
  const auto add = [&](const Vec3& point, double other) {
    (other < value ? points.low : points.high).push_back(point);
  };
  for (const Facet& facet : facets) {
    if (facet.cap) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = facet.corners[i], &b = facet.corners[(i + 1) % 3];
      if (a[axis] == value && b[axis] != value) add(a, b[axis]);
      if (b[axis] == value && a[axis] != value) add(b, a[axis]);
      if ((a[axis] - value) * (b[axis] - value) >= 0) continue;
      points.low.push_back(plus(a, times(minus(b, a), (value - a[axis]) / (b[axis] - a[axis]))));
      points.high.push_back(points.low.back());
    }
  }
  return points;
}

/// Volumes of rough hulls of what lies on one side of each plane, low or high. Each half is in the next one: hulls grow
/// by the points between two planes, and what is inside already is not looked at again.
std::vector<double> volumes_beside(const std::vector<Vec3>& points, std::size_t axis, const std::vector<double>& planes,
                                   const std::vector<CutPoints>& cuts, bool low) {
  std::vector<Vec3> ordered = points;
  std::sort(ordered.begin(), ordered.end(),
            [&](const Vec3& a, const Vec3& b) { return low ? a[axis] < b[axis] : a[axis] > b[axis]; });
  std::vector<double> volumes(planes.size());
  std::vector<Vec3> carried;
  auto next = ordered.begin();
  for (std::size_t step = 0; step < planes.size(); ++step) {
    const std::size_t i = low ? step : planes.size() - 1 - step;
    for (; next != ordered.end() && (low ? (*next)[axis] < planes[i] : (*next)[axis] > planes[i]); ++next)
      carried.push_back(*next);
    const std::vector<Vec3>& cut = low ? cuts[i].low : cuts[i].high;
    carried.insert(carried.end(), cut.begin(), cut.end());
    Hull hull = rough_hull(carried);
    volumes[i] = hull.volume;
    if (hull.volume > 0) carried = std::move(hull.points);
  }
  return volumes;
}

/// All that are tried, those that seem to take away most first. Rough hulls lack corners now and then, so what is found
/// here is at least what a cut takes away.
std::vector<Cut> likely_cuts(const Part& part, const std::vector<Vec3>& points) {
  std::vector<Cut> likely;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> planes = planes_to_try(points, axis);
    std::vector<CutPoints> cuts;
    for (const double value : planes) cuts.push_back(cut_points(part.facets, axis, value));
    const auto low = volumes_beside(points, axis, planes, cuts, true);
    const auto high = volumes_beside(points, axis, planes, cuts, false);
    for (std::size_t i = 0; i < planes.size(); ++i)
      likely.push_back({axis, planes[i], part.hull.volume - low[i] - high[i]});
  }
  std::stable_sort(likely.begin(), likely.end(), [](const Cut& a, const Cut& b) { return a.gain > b.gain; });
  return likely;
}

/// What a cut takes away; none if a half is flat.
std::optional<double> gain_of(const Part& part, std::size_t axis, double value) {
  const Halves halves = clip(part.facets, axis, value);
  const auto first = convex_hull(surface_points(halves.low)), second = convex_hull(surface_points(halves.high));
  if (!first || !second) return std::nullopt;
  return part.hull.volume - first->volume - second->volume;
}

/// In the middle of the longest extent that can be cut there.
Cut middle_cut(const Part& part, const std::vector<Vec3>& points) {
  std::array<Cut, 3> middles;
  std::array<double, 3> extents{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                                 [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    extents[axis] = (*high)[axis] - (*low)[axis];
    middles[axis] = {axis, (*low)[axis] + extents[axis] / 2, 0};
  }
  std::stable_sort(middles.begin(), middles.end(),
                   [&](const Cut& a, const Cut& b) { return extents[a.axis] > extents[b.axis]; });
  for (const Cut& middle : middles)
    if (const auto gain = gain_of(part, middle.axis, middle.value)) return {middle.axis, middle.value, *gain};
  return {};
}

Cut best_cut(const Part& part, double least) {
  const std::vector<Vec3> points = surface_points(part.facets);
  Cut best;
  for (const Cut& likely : likely_cuts(part, points)) {
    if (likely.gain <= std::max(best.gain, least)) break;
    const auto gain = gain_of(part, likely.axis, likely.value);
    if (gain && *gain > std::max(best.gain, least)) best = {likely.axis, likely.value, *gain};
  }
  return best.value == no_place ? middle_cut(part, points) : best;
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
