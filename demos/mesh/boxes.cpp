// SPDX-License-Identifier: MIT
#include "mesh/boxes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace boxstream::mesh {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double largest_float = std::numeric_limits<float>::max();

}  // namespace

float rounded_down(double x) {
  if (x > largest_float) return std::numeric_limits<float>::max();
  if (x < -largest_float) return -infinity;
  const auto near = static_cast<float>(x);
  return static_cast<double>(near) > x ? std::nextafter(near, -infinity) : near;
}

float rounded_up(double x) {
  return -rounded_down(-x);
}

Aabb box_of(const Triangle& t) {
  Aabb box{};
  for (std::size_t d = 0; d < 3; ++d) {
    box.min[d] = rounded_down(std::min({t[0][d], t[1][d], t[2][d]}));
    box.max[d] = rounded_up(std::max({t[0][d], t[1][d], t[2][d]}));
  }
  return box;
}

Aabb box_of(const Vec3& point, double reach) {
  Aabb box{};
  for (std::size_t d = 0; d < 3; ++d) {
    box.min[d] = rounded_down(point[d] - reach);
    box.max[d] = rounded_up(point[d] + reach);
  }
  return box;
}

double largest_side(const TriangleMesh& mesh) {
  double largest = 0;
  for (const auto& c : mesh.triangles)
    for (std::size_t d = 0; d < 3; ++d) {
      const auto [low, high] = std::minmax({mesh.vertices[c[0]][d], mesh.vertices[c[1]][d], mesh.vertices[c[2]][d]});
      largest = std::max(largest, high - low);
    }
  return largest;
}

void check(const std::vector<Vec3>& points) {
  for (const Vec3& point : points)
    for (const double x : point)
      if (x != 0 && !(std::abs(x) >= least_magnitude && std::abs(x) <= largest_magnitude))
        throw std::invalid_argument("a coordinate that is not finite, or too small or too large to compute with");
}

void check(const TriangleMesh& mesh) {
  check(mesh.vertices);
  for (const auto& corners : mesh.triangles)
    for (const std::uint32_t v : corners)
      if (v >= mesh.vertices.size()) throw std::invalid_argument("a triangle with a vertex that is not there");
}

}  // namespace boxstream::mesh
