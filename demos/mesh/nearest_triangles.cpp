// SPDX-License-Identifier: MIT
#include "mesh/nearest_triangles.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace boxstream::mesh {
namespace {

constexpr std::size_t largest_leaf = 4;

/// The distance of a point to a box, squared.
double squared_distance(const Aabb& box, const Vec3& p) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double below = static_cast<double>(box.min[d]) - p[d], above = p[d] - static_cast<double>(box.max[d]);
    const double gap = std::max({below, above, 0.0});
    sum += gap * gap;
  }
  return sum;
}

std::size_t longest_axis(const Aabb& box) {
  std::size_t longest = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (box.max[d] - box.min[d] > box.max[longest] - box.min[longest]) longest = d;
  return longest;
}

}  // namespace

NearestTriangles::NearestTriangles(const TriangleMesh& mesh) {
  check(mesh);
  if (mesh.triangles.empty()) throw std::invalid_argument("a mesh without triangles has no distance to anything");
  std::vector<Item> items;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle t = triangle_of(mesh, i);
    Item item{box_of(t), {}, i};
    for (std::size_t d = 0; d < 3; ++d) item.centre[d] = rounded_down((t[0][d] + t[1][d] + t[2][d]) / 3);
    items.push_back(item);
  }
  build(items, 0, items.size());
  places_.resize(items.size());
  triangles_.reserve(items.size());
  for (const Item& item : items) {
    places_[item.number] = static_cast<std::uint32_t>(numbers_.size());
    numbers_.push_back(item.number);
    triangles_.emplace_back(triangle_of(mesh, item.number));
  }
}

/// Halves the items at the median along the longest side of their box.
void NearestTriangles::build(std::vector<Item>& items, std::size_t first, std::size_t count) {
  const std::size_t place = nodes_.size();
  Aabb box = items[first].box;
  for (std::size_t i = 1; i < count; ++i) box = merged(box, items[first + i].box);
  nodes_.push_back({box});
  if (count <= largest_leaf) {
    nodes_[place].first = static_cast<std::uint32_t>(first);
    nodes_[place].count = static_cast<std::uint32_t>(count);
    return;
  }
  const std::size_t axis = longest_axis(box), half = count / 2;
  const auto begin = items.begin() + static_cast<std::ptrdiff_t>(first);
  std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half), begin + static_cast<std::ptrdiff_t>(count),
                   [&](const Item& a, const Item& b) { return a.centre[axis] < b.centre[axis]; });
  build(items, first, half);
  nodes_[place].second_child = static_cast<std::uint32_t>(nodes_.size());
  build(items, first + half, count - half);
}

Nearest NearestTriangles::nearest(const Vec3& point, std::uint32_t hint) const {
  Nearest best;
  const auto compare_with = [&](std::uint32_t place) {
    const double squared = triangles_[place].squared(point, best.squared);
    if (squared < best.squared) best = {squared, numbers_[place]};
  };
  if (hint != Nearest::none) compare_with(places_[hint]);
  // Halving 2^32 triangles takes 32 levels, each with one child that waits.
  std::array<std::pair<double, std::uint32_t>, 33> waiting;
  std::size_t count = 0;
  waiting[count++] = {squared_distance(nodes_[0].box, point), 0};
  while (count > 0) {
    const auto [squared, place] = waiting[--count];
    if (squared > best.squared) continue;
    const Node& node = nodes_[place];
    for (std::uint32_t i = 0; i < node.count; ++i) compare_with(node.first + i);
    if (node.count > 0) continue;
    std::pair<double, std::uint32_t> near{squared_distance(nodes_[place + 1].box, point), place + 1};
    std::pair<double, std::uint32_t> far{squared_distance(nodes_[node.second_child].box, point), node.second_child};
    if (far.first < near.first) std::swap(near, far);
    waiting[count++] = far;
    waiting[count++] = near;
  }
  return best;
}

std::vector<Nearest> NearestTriangles::nearest(const std::vector<Vec3>& points) const {
  check(points);
  std::vector<Nearest> result;
  result.reserve(points.size());
  for (const Vec3& point : points)
    result.push_back(nearest(point, result.empty() ? Nearest::none : result.back().triangle));
  return result;
}

}  // namespace boxstream::mesh
