// SPDX-License-Identifier: MIT
#include "import/convex_parts.hpp"

#include <algorithm>
#include <stdexcept>

#include "import/clip.hpp"
#include "import/frame.hpp"
#include "import/solid.hpp"

namespace boxstream::imports {
namespace {

/// Planes that are tried across each axis: at vertices, where notches end, and in between.
constexpr std::size_t planes_at_vertices = 8;
constexpr std::size_t planes_between = 7;

/// A cut that takes away less than this fraction of the whole is not worth a hull.
constexpr double least_gain = 1e-4;

std::vector<Vec3> surface_points(const std::vector<Facet>& facets) {
  std::vector<Vec3> points;
  for (const Facet& facet : facets)
    if (!facet.cap) points.insert(points.end(), facet.corners.begin(), facet.corners.end());
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

struct Cut {
  std::size_t axis = 0;
  double value = 0;
  double gain = 0;  // hull volume that it takes away
};

struct Part {
  std::vector<Facet> facets;
  Hull hull;
  Cut best;
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

Cut best_cut(const Part& part) {
  Cut best;
  const std::vector<Vec3> points = surface_points(part.facets);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double value : planes_to_try(points, axis)) {
      const Halves halves = clip(part.facets, axis, value);
      const auto low = convex_hull(surface_points(halves.low)), high = convex_hull(surface_points(halves.high));
      if (!low || !high) continue;
      const double gain = part.hull.volume - low->volume - high->volume;
      if (gain > best.gain) best = {axis, value, gain};
    }
  }
  return best;
}

Part make_part(std::vector<Facet> facets) {
  auto hull = convex_hull(surface_points(facets));
  if (!hull) throw std::runtime_error("the mesh is flat");
  Part part{std::move(facets), std::move(*hull), {}};
  part.best = best_cut(part);
  return part;
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
  std::vector<Part> parts;
  parts.push_back(make_part(std::move(facets)));
  const double whole = parts[0].hull.volume;
  const bool solid = closed && volume > least_gain * whole;

  double hulls = whole;
  const double worth = whole * (solid ? least_gain : std::max(least_gain, options.max_error));
  while (parts.size() < options.max_hulls && !(solid && hulls - volume <= options.max_error * volume)) {
    const auto next = std::max_element(parts.begin(), parts.end(),
                                       [](const Part& a, const Part& b) { return a.best.gain < b.best.gain; });
    if (next->best.gain <= worth) break;
    Halves halves = clip(next->facets, next->best.axis, next->best.value);
    hulls -= next->best.gain;
    *next = make_part(std::move(halves.low));
    parts.push_back(make_part(std::move(halves.high)));
  }

  ConvexParts result;
  hulls = 0;
  for (Part& part : parts) {
    hulls += part.hull.volume;
    result.hulls.push_back(std::move(part.hull));
  }
  if (solid) result.error = hulls / volume - 1;
  return result;
}

}  // namespace boxstream::imports
