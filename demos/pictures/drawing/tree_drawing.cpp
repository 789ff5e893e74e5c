// SPDX-License-Identifier: MIT
#include "tree_drawing.hpp"

#include <algorithm>

#include "canvas.hpp"

namespace boxstream::picture {

namespace {

constexpr double width = 1000, height = 500;
constexpr Rect area{40, 80, 920, 370};
constexpr double largest_radius = 7;
constexpr Colour ink{0.12F, 0.16F, 0.22F}, faint_ink{0.42F, 0.46F, 0.52F};

struct Place {
  double x = 0;  ///< in leaves
  std::size_t depth = 0, children = 0;
};

/// Leaves get the numbers 0, 1, ... in the order of the nodes, which is that of a walk.
std::vector<Place> places(const std::vector<TreeDrawing::Node>& nodes, std::size_t& leaves) {
  std::vector<Place> all(nodes.size());
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    all[i].depth = all[nodes[i].parent].depth + 1;
    ++all[nodes[i].parent].children;
  }
  leaves = 0;
  for (Place& place : all)
    if (place.children == 0) place.x = static_cast<double>(leaves++);
  // Children come after their parents, so that backwards each is complete when it is added to the one above.
  for (std::size_t i = nodes.size(); i-- > 1;) {
    if (all[i].children > 0) all[i].x /= static_cast<double>(all[i].children);
    all[nodes[i].parent].x += all[i].x;
  }
  if (all[0].children > 0) all[0].x /= static_cast<double>(all[0].children);
  return all;
}

void dot(Canvas& canvas, double x, double y, double radius, Colour colour) {
  canvas.fill({x - radius, y - radius, 2 * radius, 2 * radius}, ink, radius);
  const double inner = 0.8 * radius;
  canvas.fill({x - inner, y - inner, 2 * inner, 2 * inner}, colour, inner);
}

}  // namespace

void write_tree(const TreeDrawing& tree, std::ostream& out, PictureFormat format) {
  std::size_t leaves = 0, depth = 0;
  const std::vector<Place> all = places(tree.nodes, leaves);
  for (const Place& place : all) depth = std::max(depth, place.depth);
  const double across = area.width / static_cast<double>(std::max<std::size_t>(1, leaves - 1));
  const double down = area.height / static_cast<double>(std::max<std::size_t>(1, depth));
  const double radius = std::min(largest_radius, 0.42 * across);
  const auto x = [&](const Place& place) { return area.x + (leaves > 1 ? across * place.x : area.width / 2); };
  const auto y = [&](const Place& place) { return area.y + down * static_cast<double>(place.depth); };
  write_page(out, format, width, height, [&](Canvas& canvas) {
    canvas.fill({0, 0, width, height}, {1, 1, 1});
    canvas.text(area.x, 34, tree.title, 20, ink, Align::left, true);
    double at = area.x + largest_radius;
    for (const TreeDrawing::Key& key : tree.keys) {
      dot(canvas, at, 51, 5, key.colour);
      canvas.text(at + 10, 56, key.text, 14, faint_ink);
      at += canvas.text_width(key.text, 14) + 40;
    }
    canvas.text(area.x, height - 14, tree.small_print, 12, faint_ink);
    for (std::size_t i = 1; i < all.size(); ++i) {
      const Place& above = all[tree.nodes[i].parent];
      canvas.line(x(above), y(above), x(all[i]), y(all[i]), faint_ink, 0.8);
    }
    for (std::size_t i = 0; i < all.size(); ++i) dot(canvas, x(all[i]), y(all[i]), radius, tree.nodes[i].colour);
  });
}

}  // namespace boxstream::picture
