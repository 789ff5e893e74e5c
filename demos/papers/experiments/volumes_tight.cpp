// SPDX-License-Identifier: MIT
// How tight bounding volumes are around a surface, level by level: figures 45 and 46, on a sphere.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "inputs/random.hpp"
#include "papers/experiments/experiment.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/experiments/volume_kinds.hpp"
#include "papers/volumes/builders.hpp"
#include "papers/volumes/objects.hpp"
#include "papers/volumes/tightness.hpp"

namespace boxstream::papers {

namespace {

using namespace volumes;
using std::numbers::pi;

/// The sphere between 45 degrees south and north, in `rows` times 4 `rows` fields of two triangles each.
std::vector<Triangle> zone_of_sphere(int rows) {
  const auto corner = [&](int column, int row, float(&out)[3]) {
    const double east = 2 * pi * column / (4 * rows), north = pi / 2 * row / rows - pi / 4;
    out[0] = static_cast<float>(std::cos(east) * std::cos(north));
    out[1] = static_cast<float>(std::sin(east) * std::cos(north));
    out[2] = static_cast<float>(std::sin(north));
  };
  return triangulated_fields(4 * rows, rows, corner);
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
  const int rows_of_fields = settings.quick ? 8 : 32;
  const std::size_t nodes_a_level = settings.quick ? 2 : 12;
  const double tolerance = settings.quick ? 0.05 : 0.01;
  const Objects objects = Objects::of(zone_of_sphere(rows_of_fields));
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
      // Nodes at even distances would all lie alike to the axes.
      batches::Random(settings.seed).shuffle(level);
      if (level.size() > nodes_a_level) level.resize(nodes_a_level);
      for (const std::uint32_t node : level)
        by_distance.add(hausdorff_tightness(
            hierarchy, node, objects,
            [&](std::uint32_t object, const Point& p) { return distance_to_triangle(objects.corners(object), p); },
            tolerance));
      rows.push_back({V::name(), objects.size(), static_cast<double>(depth), by_distance.value(), 0});
      outcome.table.rows.push_back({V::name(), std::to_string(depth), fmt::format("{:.0f}", triangles.value()),
                                    fmt::format("{:.3f}", by_distance.value()),
                                    fmt::format("{:.3f}", by_children.value()),
                                    fmt::format("{:.3g}", by_leaves.value())});
    }
  });
  picture::Plot plot = plot_of(rows, fmt::format("Tightness around a sphere's zone of {} triangles", objects.size()),
                               "depth in the hierarchy", "h(B, G) / diam(G)");
  plot.x = plot.y = picture::Axis::linear;
  outcome.plots.push_back(plot);
  return outcome;
}

}  // namespace boxstream::papers
