// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>

#include "papers/hybrid/bipartite.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {

static_assert(sizeof(Cube) == 20, "figure 19");
static_assert(VersionFour::bytes_per_box == 20, "table 3");

namespace {

std::vector<Cube> numbered(Span<const Cube> cubes) {
  std::vector<Cube> copies(cubes.begin(), cubes.end());
  for (std::size_t i = 0; i < copies.size(); ++i) copies[i].num = static_cast<std::int32_t>(i);
  return copies;
}

}  // namespace

VersionFour::VersionFour(Span<const Cube> a, Span<const Cube> b) : a_(numbered(a)), b_(numbered(b)) {}

void VersionFour::find_pairs(const HybridOptions& options, Found found) {
  find_bipartite(Span<Cube>(a_), Span<Cube>(b_), options, found, NoTrace{});
}

Cube bounding_cube(const Box& box) {
  Cube cube{};
  for (int d = 0; d < 3; ++d) {
    cube.lo[d] = box.projections[d].lo;
    cube.side = std::max(cube.side, box.projections[d].hi - box.projections[d].lo);
  }
  return cube;
}

std::vector<Cube> bounding_cubes(Span<const Box> boxes) {
  std::vector<Cube> cubes;
  for (const Box& box : boxes) cubes.push_back(bounding_cube(box));
  return cubes;
}

std::vector<Box> as_boxes(Span<const Cube> cubes) {
  std::vector<Box> boxes;
  for (const Cube& c : cubes)
    boxes.push_back({{{c.lo[0], c.lo[0] + c.side}, {c.lo[1], c.lo[1] + c.side}, {c.lo[2], c.lo[2] + c.side}}});
  return boxes;
}

}  // namespace boxstream::papers
