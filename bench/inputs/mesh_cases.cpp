// SPDX-License-Identifier: MIT
#include "inputs/mesh_cases.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/generators.hpp"

namespace boxstream::bench {

namespace {

using mesh::TriangleMesh;

/// The number of cells around a surface of about n triangles.
std::size_t side(std::size_t triangles) {
  return std::max<std::size_t>(8, static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles))));
}
TriangleMesh klein(std::size_t triangles) {
  const std::size_t n = side(triangles);
  return mesh::klein_bottle(n, std::max<std::size_t>(4, n / 4 * 2));
}
TriangleMesh sphere(std::size_t triangles, double radius = 1) {
  const std::size_t n = side(triangles);
  return mesh::sphere(n / 2, n, radius);
}
TriangleMesh torus(std::size_t triangles, double tube = 0.4) {
  const std::size_t n = side(triangles);
  return mesh::torus(n, n / 2, tube);
}

const MeshCase cases[] = {
    {"klein:self", "self-intersections of a Klein bottle", [](std::size_t n) { return klein(n); }, nullptr, false},
    {"torus:self", "of a torus, which has none", [](std::size_t n) { return torus(n); }, nullptr, false},
    {"sphere:near", "distance of the same sphere in other triangles", [](std::size_t n) { return sphere(n); },
     [](std::size_t n) { return sphere(n - n / 10); }, false},
    {"klein:fine", "distance of a Klein bottle from a coarse one", [](std::size_t n) { return klein(n / 10); },
     [](std::size_t n) { return klein(n); }, false},
    {"klein:coarse", "distance of a coarse Klein bottle from a fine one", [](std::size_t n) { return klein(n); },
     [](std::size_t n) { return klein(n / 10); }, false},
    {"torus:apart", "distance of a torus from one that is a fiftieth smaller",
     [](std::size_t n) { return torus(n, 0.38); }, [](std::size_t n) { return torus(n); }, true},
    {"sphere:far", "distance of a sphere from one of one and a half times its radius",
     [](std::size_t n) { return sphere(n, 1.5); }, [](std::size_t n) { return sphere(n); }, true},
};

}  // namespace

Span<const MeshCase> mesh_cases() {
  return cases;
}

}  // namespace boxstream::bench
