// SPDX-License-Identifier: MIT
#include "inputs/set_cases.hpp"

#include <cmath>

#include "inputs/batches.hpp"
#include "mesh/boxes.hpp"
#include "mesh/generators.hpp"

namespace boxstream::bench {

namespace {

using mesh::TriangleMesh;
using Vec3 = mesh::Vec3;

/// Waves along both circles of a torus, a tenth as high as it is wide.
void make_bumpy(TriangleMesh& mesh) {
  for (Vec3& v : mesh.vertices) {
    const double around = std::atan2(v[2], v[0]), bump = 1 + 0.1 * std::sin(9 * around) * std::cos(14 * v[1]);
    for (double& x : v) x *= bump;
  }
}

/// A tenth of a turn about y, then 0.7 radians about x.
void turn(TriangleMesh& mesh) {
  const double s1 = std::sin(0.63), c1 = std::cos(0.63), s2 = std::sin(0.7), c2 = std::cos(0.7);
  for (Vec3& v : mesh.vertices) {
    const double x = c1 * v[0] + s1 * v[2], z = c1 * v[2] - s1 * v[0];
    v = {x, c2 * v[1] - s2 * z, s2 * v[1] + c2 * z};
  }
}

std::vector<Aabb> boxes_of(const TriangleMesh& mesh) {
  std::vector<Aabb> boxes;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) boxes.push_back(mesh::box_of(mesh::triangle_of(mesh, t)));
  return boxes;
}

}  // namespace

TwoSets few_against_many(std::size_t few, std::size_t n, std::uint64_t seed) {
  const std::vector<Aabb> all = batches::make("D", few + n, seed);
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(few);
  return {{all.begin(), middle}, {middle, all.end()}};
}

TwoSets turned_meshes(std::size_t n) {
  const auto rings = std::max<std::size_t>(8, static_cast<std::size_t>(std::sqrt(static_cast<double>(n))));
  TriangleMesh mesh = mesh::torus(rings, rings / 2);
  make_bumpy(mesh);
  TwoSets sets;
  sets.a = boxes_of(mesh);
  turn(mesh);
  sets.b = boxes_of(mesh);
  return sets;
}

Filtered mostly_static(std::size_t n, std::uint64_t seed) {
  Filtered filtered{batches::make("U", n, seed), {}, {}};
  std::vector<std::uint32_t> moving, still;
  for (std::uint32_t i = 0; i < n; ++i) {
    const bool moves = i % 10 == 0;
    (moves ? moving : still).push_back(i);
    filtered.filters.push_back(moves ? Filter{1, 3} : Filter{2, 1});
  }
  filtered.parts = {{moving, {}}, {moving, still}};
  return filtered;
}

Filtered ten_groups(std::size_t n, std::uint64_t seed) {
  Filtered filtered{batches::make("U", n, seed), {}, {}};
  filtered.parts.resize(10);
  for (std::uint32_t i = 0; i < n; ++i) {
    filtered.parts[i % 10].a.push_back(i);
    filtered.filters.push_back({1u << i % 10, 1u << i % 10});
  }
  return filtered;
}

}  // namespace boxstream::bench
