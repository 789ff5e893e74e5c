// SPDX-License-Identifier: MIT
#include "inputs/set_cases.hpp"

#include <algorithm>
#include <cmath>

#include "inputs/batches.hpp"
#include "inputs/random.hpp"
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

TriangleMesh bumpy_torus(std::size_t triangles) {
  const auto rings = std::max<std::size_t>(8, static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles))));
  TriangleMesh mesh = mesh::torus(rings, rings / 2);
  make_bumpy(mesh);
  return mesh;
}

std::vector<Aabb64> flat_boxes(std::size_t n, batches::Random& random) {
  const double side = std::sqrt(static_cast<double>(n));
  std::vector<Aabb64> boxes(n);
  for (Aabb64& box : boxes) {
    box = {};
    for (int d = 0; d < 2; ++d) {
      box.min[d] = side * random.unit();
      box.max[d] = box.min[d] + 3 * random.unit();
    }
  }
  return boxes;
}

std::vector<Aabb64> voxels(std::size_t n, batches::Random& random) {
  const auto edge = static_cast<std::size_t>(std::ceil(std::cbrt(3.0 * static_cast<double>(n))));
  std::vector<Aabb64> boxes;
  for (std::size_t place = 0; place < edge * edge * edge; ++place) {
    const std::size_t at[3] = {place % edge, place / edge % edge, place / edge / edge};
    Aabb64 box;
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<double>(at[d]);
      box.max[d] = box.min[d] + 1;
    }
    boxes.push_back(box);
  }
  random.shuffle(boxes);
  boxes.resize(n);
  return boxes;
}

/// Rows of rectangles of different widths, which touch each other and those of the rows beside.
std::vector<Aabb64> parcels(std::size_t n, double unit, batches::Random& random) {
  const auto in_row = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  constexpr int depth = 2000;
  std::vector<Aabb64> boxes;
  for (int row = 0; boxes.size() < n; ++row)
    for (std::int64_t i = 0, at = 0; i < static_cast<std::int64_t>(in_row) && boxes.size() < n; ++i) {
      const std::int64_t end = at + random.integer(300, 3300);
      boxes.push_back({{static_cast<double>(at) * unit, row * depth * unit, 0},
                       {static_cast<double>(end) * unit, (row + 1) * depth * unit, 0}});
      at = end;
    }
  random.shuffle(boxes);
  return boxes;
}

}  // namespace

TwoSets few_against_many(std::size_t few, std::size_t n, std::uint64_t seed) {
  const std::vector<Aabb> all = batches::make("D", few + n, seed);
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(few);
  return {{all.begin(), middle}, {middle, all.end()}};
}

TwoSets turned_meshes(std::size_t n) {
  TriangleMesh mesh = bumpy_torus(n);
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

std::vector<Aabb64> shared_ends(const std::string& name, std::size_t n, std::uint64_t seed) {
  batches::Random random(seed);
  if (name == "flat") return flat_boxes(n, random);
  if (name == "voxels") return voxels(n, random);
  if (name == "parcels") return parcels(n, 1, random);
  if (name == "cents") return parcels(n, 0.01, random);
  TriangleMesh mesh = bumpy_torus(n);
  turn(mesh);
  std::vector<Aabb64> boxes;
  for (const auto& triangle : mesh.triangles) {
    Aabb64 box;
    for (int d = 0; d < 3; ++d) {
      const auto [low, high] = std::minmax({mesh.vertices[triangle[0]][static_cast<std::size_t>(d)],
                                            mesh.vertices[triangle[1]][static_cast<std::size_t>(d)],
                                            mesh.vertices[triangle[2]][static_cast<std::size_t>(d)]});
      box.min[d] = low;
      box.max[d] = high;
    }
    boxes.push_back(box);
  }
  return boxes;
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
