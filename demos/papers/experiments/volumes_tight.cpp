// SPDX-License-Identifier: MIT
// How tight bounding volumes are around a surface, level by level: figures 45 and 46, on a sphere.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "papers/experiments/experiment.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/experiments/volume_kinds.hpp"
#include "papers/volumes/builders.hpp"
#include "papers/volumes/tightness.hpp"
#include "papers/volumes/triangle_distance.hpp"

namespace boxstream::papers {

namespace {

using namespace volumes;

/// An octahedron whose triangles were cut in four, and cast onto the sphere, `times` times: 8 * 4^times triangles.
std::vector<Triangle> sphere_surface(int times) {
  using Corners = std::array<Point, 3>;
  std::vector<Corners> surface;
  for (const double x : {-1, 1})
    for (const double y : {-1, 1})
      for (const double z : {-1, 1}) surface.push_back({Point(x, 0, 0), Point(0, y, 0), Point(0, 0, z)});
  for (int i = 0; i < times; ++i) {
    std::vector<Corners> finer;
    for (const Corners& c : surface) {
      const Point ab = (c[0] + c[1]).normalized(), bc = (c[1] + c[2]).normalized(), ca = (c[2] + c[0]).normalized();
      for (const Corners& part :
           {Corners{c[0], ab, ca}, Corners{ab, c[1], bc}, Corners{ca, bc, c[2]}, Corners{ab, bc, ca}})
        finer.push_back(part);
    }
    surface = std::move(finer);
  }
  std::vector<Triangle> triangles;
  for (const Corners& corners : surface) {
    Triangle triangle{};
    for (std::size_t i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d) triangle.corners[i][d] = static_cast<float>(corners[i][d]);
    triangles.push_back(triangle);
  }
  return triangles;
}

/// Of those that are numbers; NaN if none is.
struct Mean {
  double sum = 0;
  std::size_t count = 0;

  void add(double value) {
    if (std::isnan(value)) return;
    sum += value;
    ++count;
  }
  double value() const { return sum / static_cast<double>(count); }
};

}  // namespace

Outcome volumes_tight(const Settings& settings) {
  const int times = settings.quick ? 3 : 5;
  const std::size_t nodes_a_level = settings.quick ? 2 : 6;
  const double tolerance = settings.quick ? 0.05 : 0.01;
  const Objects objects = Objects::of(sphere_surface(times));
  const Tree tree = build(Builder::principal_axis, objects);
  Outcome outcome;
  outcome.table.columns = {"volume", "depth", "triangles", "by distance", "by children", "by leaves"};
  std::vector<Row> rows;
  for_each_volume([&]<class V>() {
    const Hierarchy<V> hierarchy(tree, objects);
    const VolumeTightness by_volume = volume_tightness(hierarchy);
    for (std::uint32_t depth = 0;; ++depth) {
      settings.progress(fmt::format("{}, depth {}", V::name(), depth));
      std::vector<std::uint32_t> level;
      Mean triangles, by_distance, by_children, by_leaves;
      for (std::uint32_t node = 0; node < tree.nodes.size(); ++node)
        if (tree.nodes[node].depth == depth) {
          level.push_back(node);
          triangles.add(tree.nodes[node].objects);
          by_children.add(by_volume.by_children[node]);
          by_leaves.add(by_volume.by_leaves[node]);
        }
      // Of less than eight triangles, the surface is that of its corners rather than that of a sphere.
      if (level.empty() || triangles.value() < 8) break;
      const std::size_t chosen = std::min(level.size(), nodes_a_level);
      for (std::size_t i = 0; i < chosen; ++i)
        by_distance.add(hausdorff_tightness(
            hierarchy, level[i * level.size() / chosen], objects,
            [&](std::uint32_t object, const Point& p) { return distance_to_triangle(objects.corners(object), p); },
            tolerance));
      rows.push_back({V::name(), objects.size(), static_cast<double>(depth), by_distance.value(), 0});
      outcome.table.rows.push_back({V::name(), std::to_string(depth), fmt::format("{:.0f}", triangles.value()),
                                    fmt::format("{:.3f}", by_distance.value()),
                                    fmt::format("{:.3f}", by_children.value()),
                                    fmt::format("{:.3f}", by_leaves.value())});
    }
  });
  picture::Plot plot = plot_of(rows, fmt::format("Tightness around a sphere of {} triangles", objects.size()),
                               "depth in the hierarchy", "h(B, G) / diam(G)");
  plot.x = plot.y = picture::Axis::linear;
  outcome.plots.push_back(plot);
  return outcome;
}

}  // namespace boxstream::papers
